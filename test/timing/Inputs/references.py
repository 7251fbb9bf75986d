#!/usr/bin/env python3
"""Writes references that scripts/validate.sh reads, by formulas of the machine's own numbers.

usage: references.py FOLDER

A loop of N independent additions, one that it counts by and a branch takes N fetches, the last addition's result, and the
branch. FOLDER gets that for two machines, but the larger loop's so many times as much. A stream of reads has the peak of its
channel but while rows are refreshed.
"""

import json
import os
import subprocess
import sys

LOOPS = {"adds_3": 3, "adds_8": 8}
MACHINES = {"rtl_2025_09": ("vortex-2025", 1.06), "rtl_2023_05_v1": ("vortex-5stage", 1.04)}  # preset, times
LPDDR4 = {"peak_gb_s": 6.4, "refresh_ns": 180, "every_ns": 3904}


def assembly(adds):
    """Each destination is written again when it has long been free."""
    body = "".join(f"  add a{3 + n % 4}, a1, a2\n" for n in range(adds))
    return ("  .globl main\nmain:\n  li s2, ITERS\n  .balign 64\n1:\n" + body +
            "  addi s2, s2, -1\n  bnez s2, 1b\n  li a0, 0\n  ret\n")


def cycles(preset, adds):
    """Of an iteration. What decrements waits behind the last addition for its turn, and the branch for its result."""
    text = subprocess.run(["vorion-sim", "--set", f"timing.core.preset={preset}", "--print-default-config"], check=True,
                          capture_output=True, text=True).stdout
    core = json.loads(text)["timing"]["core"]
    result = max(core["fetch_interval"], core["alu_latency"] + core["use_delay"])
    return adds * core["fetch_interval"] + result + core["branch_cycles"]


def main():
    folder = sys.argv[1]
    os.makedirs(folder, exist_ok=True)

    def reference(machine, loop):
        preset, times = MACHINES[machine]
        return cycles(preset, LOOPS[loop]) * (times if loop == "adds_8" else 1)

    def write(name, what):
        with open(os.path.join(folder, name), "w") as file:
            json.dump(what, file)

    first, *others = MACHINES
    write("vortex_core_cpi.json", {"kernels": [
        {"name": loop, "assembly": assembly(adds), "iterations": [10, 30],
         "cycles_per_iteration": {first: reference(first, loop)}} for loop, adds in LOOPS.items()]})
    write("vortex_more.json", [
        {"name": machine, "results": [
            {"kernel": loop, "cycles_per_iteration": reference(machine, loop), "comparable": loop == "adds_8"}
            for loop in LOOPS]} for machine in others])
    streamed = LPDDR4["peak_gb_s"] * (1 - LPDDR4["refresh_ns"] / LPDDR4["every_ns"])
    speed = {"gb_s": streamed, "mean_read_ns": None}
    write("dram_lpddr4_3200.json", {"patterns": [
        {"name": "stream_read", "ramulator": speed, "ramulator_front_20ns": speed,
         "ramulator_queues_of_32_bursts": speed}]})


main()
