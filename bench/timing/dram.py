#!/usr/bin/env python3
"""Our DRAM controller beside a reference, pattern by pattern, as a Markdown table.

usage: dram.py REFERENCE.json [--patterns PROGRAM]

REFERENCE.json has "patterns", a list of objects with name, requests, and "ramulator", "ramulator_queues_of_32_bursts" and
"ramulator_front_20ns" with gb_s and mean_read_ns. PROGRAM is bench/timing's dram_patterns. The exit code is 1 if a bandwidth
is farther off than the pattern's limit.
"""

import argparse
import json
import os
import subprocess
import sys

sys.path.append(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
import command_line

# Relative limits of bandwidth. Where writes are mixed in or two rows of a bank compete, schedulers differ: what the
# reference says with queues of 32 and of 64 bursts, widened by 5 %.
RANDOM_LIMIT = 0.05
LIMIT = 0.02
WIDENED = 0.05
RANGES = ("random_4_to_1", "random_1_to_1", "stream_1_to_1", "two_streams_same_bank")


def run(program, *options):
    done = subprocess.run([program, *options], check=True, capture_output=True, text=True)
    return json.loads(done.stdout)["closed"]


def bounds(name, reference):
    """Least and greatest bandwidth that passes."""
    base = reference["ramulator"]["gb_s"]
    if name in RANGES:
        both = (base, reference["ramulator_queues_of_32_bursts"]["gb_s"])
        return min(both) * (1 - WIDENED), max(both) * (1 + WIDENED)
    limit = RANDOM_LIMIT if name.startswith("random_read") and name != "random_read_1" else LIMIT
    return base * (1 - limit), base * (1 + limit)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("reference")
    parser.add_argument("--patterns", default="dram_patterns")
    args = parser.parse_args()
    with open(args.reference) as file:
        references = {p["name"]: p for p in json.load(file)["patterns"]}
    ours = {"ramulator": run(args.patterns), "ramulator_front_20ns": run(args.patterns, "--front-ns", "20"),
            "ramulator_queues_of_32_bursts": run(args.patterns, "--queue", "32")}
    print("| pattern | ours | reference | ratio | latency, ns | reference | ratio with 20 ns in front | with queues of 32 |")
    print("|---|--:|--:|--:|--:|--:|--:|--:|")
    failed = []
    for name, reference in references.items():
        ratio = {key: ours[key][name]["gb_s"] / reference[key]["gb_s"] for key in ours}
        mine, theirs = ours["ramulator"][name], reference["ramulator"]
        latency = ("", "") if theirs["mean_read_ns"] is None else (
            f"{mine['mean_read_ns']:.2f}", f"{theirs['mean_read_ns']:.2f}")
        print(f"| `{name}` | {mine['gb_s']:.3f} | {theirs['gb_s']:.3f} | {ratio['ramulator']:.4f} | {latency[0]} "
              f"| {latency[1]} | {ratio['ramulator_front_20ns']:.4f} | {ratio['ramulator_queues_of_32_bursts']:.4f} |")
        least, greatest = bounds(name, reference)
        if not least <= mine["gb_s"] <= greatest:
            failed.append(f"{name}: {mine['gb_s']:.3f} GB/s, expected {least:.3f} to {greatest:.3f}")
    for line in failed:
        print(f"dram.py: error: {line}", file=sys.stderr)
    return 1 if failed else 0


if __name__ == "__main__":
    command_line.run(main)
