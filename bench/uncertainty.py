#!/usr/bin/env python3
"""How far a frame's time may be off: its interval when everything that no source gives is drawn at random.

usage: uncertainty.py SCENE --cameras FILE --view NAME --out FOLDER [--config MACHINE] [--samples N] [--seed S]

What is drawn: each value of the clock whose source says "ours" (vorion-sim --print-timing-parameters), from half to
twice what it is; words and powers of two among their choices; the link, where the machine has one, in the interval
of docs/model.md; a launch as 0, 2 or 20 us. Values are drawn evenly in their logarithm, by a Latin hypercube: each of N
equal parts of a parameter's interval is used once. Switches stay, because they are choices and not values.

Each sample draws the view with the rasterizer and with the cores alone. Prints the 5 to 95 % interval of both times and
of their ratio, and which parameters the time follows most (Spearman's rank correlation). FOLDER keeps each frame
(docs/studies.md). Exit codes: 0 done, 1 a frame failed, 2 usage.
"""

import argparse
import json
import math
import random
import statistics
import subprocess

import clocked
import command_line
import study
import timed_frame

LINK = {"l2_mhz": (100, 200), "to_l2_ns": (10, 100), "from_l2_ns": (10, 100), "to_l2_mbps": (1600, 12800),
        "from_l2_mbps": (1600, 12800)}
LAUNCH = [0, 2000, 20000]
WORDS = {"address_map": ["digit_sum", "row_bank_column", "xor"], "refresh": ["rank", "none"]}
POWERS_OF_TWO = {"channel_bytes": [64, 128, 256, 512, 1024]}


def ours():
    """(group, name) of every parameter whose source says "ours"."""
    group = None
    text = subprocess.run(["vorion-sim", "--print-timing-parameters"], check=True, capture_output=True, text=True).stdout
    for line in text.splitlines():
        if line.startswith("`timing."):
            group = line.split("`")[1].removeprefix("timing.")
        elif line.startswith("| `"):
            cells = [cell.strip() for cell in line.split("|")]
            if cells[-3] != "bool" and "ours" in cells[-2]:
                yield group, cells[1].strip("`")


def limits():
    """By group, the schema's description of each value."""
    text = subprocess.run(["vorion-sim", "--print-config-schema"], check=True, capture_output=True, text=True).stdout
    groups = json.loads(text)["properties"]["timing"]["properties"]
    return {group: description.get("properties", {}) for group, description in groups.items()}


def dimensions(timing):
    """By (group, name): the choices, or the two ends of an interval."""
    found, schema = {}, limits()
    for group, name in ours():
        value = timing[group][name]
        if group == "link":
            continue
        if name in WORDS or name in POWERS_OF_TWO:
            found[group, name] = (WORDS | POWERS_OF_TWO)[name]
        elif value:  # 0 is none, or no bound
            allowed = schema[group][name]
            found[group, name] = (max(1, allowed["minimum"], value / 2), min(allowed["maximum"], value * 2))
    found["host", "launch_ns"] = LAUNCH
    if timing["link"]["l2_mhz"]:
        found |= {("link", name): ends for name, ends in LINK.items()}
    return found


def value_at(domain, part):
    """A domain's value at \\p part of it, 0 to 1."""
    if isinstance(domain, list):
        return domain[int(part * len(domain))]
    low, high = domain
    return round(low * (high / low) ** part)


def samples(domains, count, seed):
    """A Latin hypercube: by (group, name), a value for each sample."""
    rng = random.Random(seed)
    drawn = [{} for _ in range(count)]
    for key, domain in domains.items():
        parts = [(n + rng.random()) / count for n in range(count)]
        rng.shuffle(parts)
        for sample, part in zip(drawn, parts):
            sample[key] = value_at(domain, part)
    return drawn


PATHS = ("raster", "simt")


def points_of(args, default, drawn):
    """Of each sample, one with the rasterizer and one with the cores alone."""
    of = timed_frame.scene_of(args)
    for number, sample in enumerate(drawn):
        config = json.loads(json.dumps(default))
        for (group, name), value in sample.items():
            config["timing"][group][name] = value
        for path in PATHS:
            yield study.render(f"{number}-{path}", of, args.view, "--time", "--path", path, VORION_CONFIG=json.dumps(config))


def results_of(drawn, measured):
    """What table() takes of each sample."""
    times = [result["report"]["time"] for result in measured]
    for number, sample in enumerate(drawn):
        own = times[len(PATHS) * number:][:len(PATHS)]
        yield {"values": {".".join(key): value for key, value in sample.items()}, "machine": clocked.name(own[-1]["sum"]),
               **{path: time["frame_ms"] for path, time in zip(PATHS, own)}}


def ranks(values):
    order = sorted(range(len(values)), key=lambda n: values[n])
    place = [0.0] * len(values)
    at = 0
    while at < len(order):
        end = at
        while end < len(order) and values[order[end]] == values[order[at]]:
            end += 1
        for n in order[at:end]:
            place[n] = (at + end - 1) / 2
        at = end
    return place


def followed(results):
    """(correlation, parameter) of those that the frame's time follows, strongest first: beyond chance at 99 %."""
    share = 2.6 / math.sqrt(len(results))
    found = []
    for name, one in results[0]["values"].items():
        values = [r["values"][name] for r in results]
        if isinstance(one, str) or len(set(values)) == 1:
            continue
        found.append((statistics.correlation(ranks(values), ranks([r["raster"] for r in results])), name))
    return sorted((f for f in found if abs(f[0]) >= share), key=lambda f: -abs(f[0]))


def interval(values):
    """5 %, median and 95 %."""
    cuts = statistics.quantiles(values, n=20, method="inclusive")
    return cuts[0], statistics.median(values), cuts[-1]


def table(base, results):
    rows = [("frame, rasterizer, ms", base["raster"], [r["raster"] for r in results]),
            ("frame, cores alone, ms", base["simt"], [r["simt"] for r in results]),
            ("times faster with the rasterizer", base["simt"] / base["raster"],
             [r["simt"] / r["raster"] for r in results])]
    print("| | as it is | 5 % | median | 95 % |\n|---|--:|--:|--:|--:|")
    for name, as_it_is, values in rows:
        print(f"| {name} | " + " | ".join(f"{v:.3g}" for v in (as_it_is, *interval(values))) + " |")
    clocked.say([base["machine"]])
    print("\nThe frame's time follows " + (", ".join(
        f"`{name}` ({c:+.2f})" for c, name in followed(results)) or "no single parameter") + ".")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    timed_frame.add_view(parser)
    parser.add_argument("--out", required=True, help="folder for the frames")
    parser.add_argument("--jobs", type=int, default=1, help="frames that are drawn at the same time (default: %(default)s)")
    parser.add_argument("--config", help="a machine's name or file; default: the default machine")
    parser.add_argument("--samples", type=int, default=64)
    parser.add_argument("--seed", type=int, default=1)
    args = parser.parse_args()
    if args.samples < 3:
        parser.error(f"--samples is {args.samples}, expected 3 or more")

    default = timed_frame.machine(args.config)
    drawn = [{}, *samples(dimensions(default["timing"]), args.samples, args.seed)]  # the first is the machine as it is
    base, *results = results_of(drawn, study.measure(list(points_of(args, default, drawn)), args.out, args.jobs))
    table(base, results)


if __name__ == "__main__":
    command_line.run(main)
