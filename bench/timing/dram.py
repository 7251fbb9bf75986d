#!/usr/bin/env python3
"""Our DRAM controller beside references, as Markdown tables: closed patterns, and random reads at given loads.

usage: dram.py REFERENCE.json... [--patterns PROGRAM] [--peer PROGRAM]

A REFERENCE.json may have "patterns", a list of objects with a name and "ramulator", which has gb_s and mean_read_ns (null for
writes alone); optionally also "ramulator_queues_of_32_bursts" and "ramulator_front_20ns". It may have "open_per_cent": for each
load in per cent of the peak "ramulator" with mean_read_ns and read_95_ns. Of several files the first that has a pattern or a
load counts, and a peer's output before them. --patterns is bench/timing's dram_patterns.

exit codes: 0 all within their limits, 1 not so, 2 usage, 3 a file is none of references
"""

import argparse
import json
import os
import subprocess
import sys

sys.path.append(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
import command_line
import peers

# Relative limits of bandwidth. Where writes are mixed in or two rows of a bank compete, schedulers differ: what the
# reference says with queues of 32 and of 64 bursts, widened by 5 %.
RANDOM_LIMIT = 0.05
LIMIT = 0.02
WIDENED = 0.05
RANGES = ("random_4_to_1", "random_1_to_1", "stream_1_to_1", "two_streams_same_bank")
# Relative limits of latencies at a load. The 95th percentile has one below the knee alone, where the reference's mean is not
# yet KNEE times that of its least load.
MEAN_LIMIT = 0.10
PERCENTILE_LIMIT = 0.20
KNEE = 2
# How our program is run for each of a reference's variants.
VARIANTS = {"ramulator": (), "ramulator_front_20ns": ("--front-ns", "20"), "ramulator_queues_of_32_bursts": ("--queue", "32")}
FIGURES = ("gb_s", "mean_read_ns")
LATENCIES = ("mean_read_ns", "read_95_ns")


class Refused(Exception):
    """One line that says why a file cannot be used."""


def check(file, where, of, keys, may_be_null=()):
    """Refuses an object that lacks one of these figures."""
    for key in keys:
        value = of.get(key, "not there") if isinstance(of, dict) else "not there"
        if not (value is None and key in may_be_null or isinstance(value, (int, float)) and value > 0):
            raise Refused(f"{file}: {where}: {key} is {value}, expected a number above 0")


def file_of(name):
    with open(name, encoding="utf-8") as file:
        return json.load(file)


def read(sources):
    """(patterns, loads) by name, of the first source that has each: (its name, what gives its JSON)."""
    patterns, loads = {}, {}
    for name, read_json in sources:
        try:
            what = read_json(name)
            listed, opened = what.get("patterns", []), what.get("open_per_cent", {})
            found = {p["name"]: p for p in listed}
            loads_found = {int(load): {"ramulator": of.get("ramulator")} for load, of in opened.items()}
        except (OSError, ValueError, KeyError, TypeError, AttributeError) as error:
            raise Refused(f"{name}: {error!r}, expected references as in bench/timing/README.md") from None
        for pattern, of in found.items():
            for variant in VARIANTS:
                if variant == "ramulator" or variant in of:
                    check(name, f"{pattern}: {variant}", of.get(variant), FIGURES, may_be_null=("mean_read_ns",))
        for load, of in loads_found.items():
            check(name, f"load of {load} %: ramulator", of.get("ramulator"), LATENCIES)
        patterns |= {key: of for key, of in found.items() if key not in patterns}
        loads |= {key: of["ramulator"] for key, of in loads_found.items() if key not in loads}
    return patterns, dict(sorted(loads.items()))


def run(program, *options):
    done = subprocess.run([program, *options], check=True, capture_output=True, text=True)
    return json.loads(done.stdout)


def bounds(name, reference):
    """Least and greatest bandwidth that passes."""
    base = reference["ramulator"]["gb_s"]
    if name in RANGES:
        both = (base, reference.get("ramulator_queues_of_32_bursts", reference["ramulator"])["gb_s"])
        return min(both) * (1 - WIDENED), max(both) * (1 + WIDENED)
    limit = RANDOM_LIMIT if name.startswith("random_read") and name != "random_read_1" else LIMIT
    return base * (1 - limit), base * (1 + limit)


def closed_table(ours, references):
    """Prints the patterns' rows; returns what is too far off."""
    print("| pattern | ours | reference | ratio | latency, ns | reference | ratio with 20 ns in front | with queues of 32 |")
    print("|---|--:|--:|--:|--:|--:|--:|--:|")
    wrong = []
    for name, reference in references.items():
        mine, theirs = ours["ramulator"]["closed"].get(name), reference["ramulator"]
        if mine is None:
            wrong.append(f"{name}: no such pattern of ours, expected one of dram_patterns")
            continue
        ratios = [f"{ours[variant]['closed'][name]['gb_s'] / reference[variant]['gb_s']:.4f}" if variant in reference else ""
                  for variant in VARIANTS]
        latency = ("", "") if theirs["mean_read_ns"] is None else (
            f"{mine['mean_read_ns']:.2f}", f"{theirs['mean_read_ns']:.2f}")
        print(f"| `{name}` | {mine['gb_s']:.3f} | {theirs['gb_s']:.3f} | {ratios[0]} | {latency[0]} "
              f"| {latency[1]} | {ratios[1]} | {ratios[2]} |")
        least, greatest = bounds(name, reference)
        if not least <= mine["gb_s"] <= greatest:
            wrong.append(f"{name}: {mine['gb_s']:.3f} GB/s, expected {least:.3f} to {greatest:.3f}")
    return wrong


def open_table(ours, references):
    """Prints a row for each load; returns what is too far off."""
    print("\nRandom reads at the times of a Poisson process, latencies in ns:\n")
    print("| load, % of the peak | mean, ours | reference | error | 95th percentile, ours | reference | error |")
    print("|--:|--:|--:|--:|--:|--:|--:|")
    wrong = []
    knee = KNEE * next(iter(references.values()))["mean_read_ns"]
    for load, theirs in references.items():
        mine = ours.get(str(load))
        if mine is None:
            wrong.append(f"load of {load} %: not of ours, expected one of {', '.join(ours)}")
            continue
        errors = {key: mine[key] / theirs[key] - 1 for key in LATENCIES}
        print(f"| {load} | " + " | ".join(f"{mine[key]:.1f} | {theirs[key]:.1f} | {round(100 * errors[key], 1) + 0:+.1f} %" for key in LATENCIES) + " |")
        limits = {"mean_read_ns": MEAN_LIMIT} | ({"read_95_ns": PERCENTILE_LIMIT} if theirs["mean_read_ns"] < knee else {})
        wrong += [f"load of {load} %: {key} is {mine[key]:.1f}, expected {theirs[key]:.1f} within {100 * limit:.0f} %"
                  for key, limit in limits.items() if abs(errors[key]) > limit]
    return wrong


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("references", nargs="+", metavar="REFERENCE.json")
    parser.add_argument("--patterns", default="dram_patterns")
    peers.add(parser)
    args = parser.parse_args()
    try:
        patterns, loads = read([(args.peer, lambda program: peers.figures(program, dict))] * bool(args.peer)
                               + [(name, file_of) for name in args.references])
    except Refused as refused:
        print(f"dram.py: error: {refused}", file=sys.stderr)
        return 3
    ours = {variant: run(args.patterns, *options) for variant, options in VARIANTS.items()}
    wrong = closed_table(ours, patterns)
    if loads:
        wrong += open_table(ours["ramulator"]["open_per_cent"], loads)
    for line in wrong:
        print(f"dram.py: error: {line}", file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    command_line.run(main)
