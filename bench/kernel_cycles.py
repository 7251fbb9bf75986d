#!/usr/bin/env python3
"""The cycles of each kernel by reason: what the cores of a machine did while an OpenCL program ran it.

usage: kernel_cycles.py [--machines NAME,...] PROGRAM [ARGUMENT ...]

Runs the program with the clock on, once on each machine, and prints a table of Markdown with a row for each kernel of
each machine, all launches together. A cycle of a core has one reason (docs/time-report.md); a column has the sum of a group.
Needs scripts/env.sh.
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile

import clocked
import command_line
from generators import clock

REASONS = {", ".join(parts): parts for parts in clock.groups_of(clock.stored()["cores"]).values()}


def runs_of(command, machine):
    """What VORION_STATS says of each run of the program on a machine, in order."""
    with tempfile.TemporaryDirectory(prefix="vorion-cycles-") as folder:
        stats = os.path.join(folder, "stats.json")
        done = subprocess.run(command, env={**os.environ, "VORION_CONFIG": machine, "VORION_TIME": "1", "VORION_STATS": stats},
                              stdout=subprocess.DEVNULL, check=False)
        if done.returncode != 0:
            raise RuntimeError(f"{command[0]}: ended with {done.returncode}, expected 0")
        with open(stats, encoding="utf-8") as file:
            return json.load(file)["runs"]


def by_kernel(runs):
    """The launches, cycles and reasons of each kernel, in the order in which they first ran."""
    found = {}
    for run in runs:
        row = found.setdefault(run["name"], {"launches": 0, "cycles": 0, "reasons": dict.fromkeys(REASONS, 0)})
        row["launches"] += 1
        row["cycles"] += run["time"]["cycles"]
        for core in run["time"]["cores"]:
            for reason, parts in REASONS.items():
                row["reasons"][reason] += sum(core[part] for part in parts)
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--machines", default="prototype,prototype-forwarding")
    parser.add_argument("program", nargs=argparse.REMAINDER)
    options = parser.parse_args()
    command_line.check_program(parser, options.program)
    names = []
    headings = ["machine", "kernel", "launches", "instr.", "cycles", *REASONS]
    for machine in options.machines.split(","):
        try:
            runs = runs_of(options.program, machine)
        except RuntimeError as problem:
            print(f"kernel_cycles.py: error: {problem}", file=sys.stderr)
            return 1
        if not names:
            print("|" + "|".join(f" {heading} " for heading in headings) + "|")
            print("|---|---|" + "--:|" * (len(headings) - 2))
        names += [clocked.name(run["time"]) for run in runs]
        for kernel, row in by_kernel(runs).items():
            total = sum(row["reasons"].values())
            cells = [machine, kernel, row["launches"], f"{row['reasons']['issue']:,}", f"{row['cycles']:,}",
                     *(f"{100 * cycles / total:.1f}" for cycles in row["reasons"].values())]
            print("|" + "|".join(f" {cell} " for cell in cells) + "|", flush=True)
    clocked.say(names)
    return 0


if __name__ == "__main__":
    command_line.run(main)
