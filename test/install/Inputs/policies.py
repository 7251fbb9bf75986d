"""What policies of plugins should do, computed from what runs did: usage policies.py random|fcfs|oldest FILE..."""
import json
import re
import sys


def loads(trace):
    """The lines that loads asked for, one each."""
    for line in open(trace):
        word = line.split()
        if word[0] == "mem" and word[4] == "load":
            assert len(word) == 7, "lanes of one line"
            yield int(word[6], 16) // 64


def hits(lines, ways, sets, victim):
    """Counts the hits of a cache in which victim() chooses the way of a full set that is replaced."""
    cache = {}
    count = 0
    for time, line in enumerate(lines):
        held = cache.setdefault(line % sets, [])  # [line, last use] by way
        found = next((entry for entry in held if entry[0] == line), None)
        if found:
            count += 1
            found[1] = time
        elif len(held) < ways:
            held.append([line, time])
        else:
            held[victim(held)] = [line, time]
    return count


def random_numbers(state=1):
    while True:
        for shift in (13, -17, 5):
            state ^= (state << shift if shift > 0 else state >> -shift) & 0xFFFFFFFF
        yield state


def random(trace, own, plugged):
    """The data cache's hits with its own policy and with random.cpp, as models of both have them."""
    lines = list(loads(trace))
    numbers = random_numbers()
    expected = (hits(lines, 4, 16, lambda held: min(range(4), key=lambda way: held[way][1])),
                hits(lines, 4, 16, lambda held: next(numbers) % 4))
    def counted(file):
        return next(a["count"] for a in json.load(open(file))["runs"][0]["time"]["activities"]
                    if (a["unit"], a["event"]) == ("data cache", "hits"))
    measured = (counted(own), counted(plugged))
    assert measured == expected, (measured, expected)
    print("hits of the data cache:", *measured)


def activations(requests):
    """The banks whose rows are opened if requests are served in their order: rows, 8 banks and columns of 2 KiB."""
    opened = {}
    banks = []
    for line in open(requests):
        address = int(line.split()[0], 16)
        bank, row = address >> 11 & 7, address >> 14
        if opened.get(bank) != row:
            opened[bank] = row
            banks.append(bank)
    return banks


def fcfs(own, plugged):
    """Rows are opened in the order of requests with fcfs.cpp, and in another one without. No run waits for the last."""
    def issued(prefix):
        commands = (line.strip().split(",") for line in open(prefix + ".0.commands"))
        return [int(bank) for _, name, bank in commands if name == "ACT"]
    in_order = activations(plugged + ".requests")
    assert len(in_order) - 1 <= len(issued(plugged)) and issued(plugged) == in_order[:len(issued(plugged))], "another order"
    assert issued(own)[:1000] != activations(own + ".requests")[:1000], "no other order"
    print("rows opened:", len(issued(own)), len(issued(plugged)))


def oldest(own, plugged):
    """When warps of the same work issue their last instruction: in turn nearly together, by number one after the other."""
    def ends(log):
        warps, now, last = {}, 0, {}
        for line in open(log):
            word = line.rstrip("\n").split("\t")
            if word[0] == "C":
                now += int(word[1])
            elif word[0] == "I":
                warps[word[1]] = int(word[3])
            elif word[0] == "R" and word[3] == "0":
                last[warps[word[1]]] = now
        return [last[warp] for warp in sorted(last)]
    in_turn, by_number = ends(own), ends(plugged)
    assert max(in_turn) - min(in_turn) < max(in_turn) / 50, in_turn
    steps = [after - before for before, after in zip([0] + by_number, by_number)]
    assert min(steps) > max(by_number) / 5, by_number
    print("warps end:", *in_turn, "and", *by_number)


globals()[sys.argv[1]](*sys.argv[2:])
