#!/usr/bin/env python3
"""The clock's L2 beside that of Vortex's RTL, as Markdown tables.

usage: l2.py [--write FOLDER] [--peer PROGRAM] [KERNEL...]

One core of 16 lanes runs the loops of l2_loops.py and the whole kernels of kernels/ with an L2 between its caches and memory
that answers after the same time. l2_references.json has the RTL's cycles. Ours are shown twice: with the L2's parameters as they are,
and with those that the RTL shows. FOLDER gets each loop as LOOP.ITERATIONS.elf and each kernel as KERNEL.elf. PROGRAM is
called with that folder and prints what takes the place of l2_references.json.

exit codes: 0 with the RTL's parameters all comparable loops are within 5 %, all kernels within 15 % and, where all are chosen,
their geometric mean within 5 %, 1 not so, 2 usage
"""

import json
import math
import os
import sys
import tempfile

sys.path.append(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
import clocked
import command_line
import cores
import kernels
import l2_loops
import peers

HERE = os.path.dirname(os.path.abspath(__file__))
# Ours has not what decides these: docs/validation.md says what that is.
NOT_COMPARABLE = ("chase_hot", "wide_8", "wide_16")
# The memory behind the L2 is a channel of DRAM whose own commands take no time to speak of, and a last-level cache that passes
# everything on. What is left is the controller's time, in ps.
FIXED_52, FIXED_59 = 92100, 105300
MEMORY = ("timing.llc.kib=1", "timing.llc.ways=1", "timing.llc.hit_cycles=1", "timing.llc.mshrs=256", "timing.dram.channels=1",
          "timing.dram.refresh=none")
PRESET = "vortex-2025"
# What ours is changed to: the L2 as it is, and with the values that the RTL shows, where a miss takes 7 cycles beside a hit's and
# the memory's 52.
OURS = (
    (f"timing.dram.controller_ps={FIXED_52}",),
    (f"timing.dram.controller_ps={FIXED_59}", "timing.l2.hit_cycles=13", "timing.l2.banks=1", "timing.l2.intersect_hint=0"),
)


def memory_table(file):
    """Writes a DRAM timing table (docs/dram.md) of a line a cycle, in ticks of an eighth of a cycle of 530 MHz."""
    ticks = {"one": {"bank": ("ACT RD", "ACT WR", "ACT PRE", "PRE ACT", "RD PRE"),
                     "rank": ("ACT PREA", "PREA ACT", "RD PREA", "ACT ACT", "PRE REF", "PREA REF", "REF ACT", "REF REF")},
             "one + one": {"bank": ("ACT ACT",)},
             "line": {"channel": ("RD RD", "WR WR", "RD WR", "WR RD")},
             "line + one": {"bank": ("WR PRE",), "rank": ("WR PREA",)}}
    constraints = [{"from": pair.split()[0], "to": pair.split()[1], "scope": scope, "ticks": many}
                   for many, scopes in ticks.items() for scope, pairs in scopes.items() for pair in pairs]
    constraints.append({"from": "ACT", "to": "ACT", "scope": "rank", "ticks": "one", "window": 4})
    with open(file, "w") as out:
        json.dump({"standard": "fixed", "source": "no device: it answers all requests after about the same time", "tick_ps": 236,
                   "ranks": 1, "bank_groups": 1, "banks_per_group": 8, "rows": 32768, "row_bytes": 2048, "burst_bytes": 64,
                   "values": {"one": [1, "ours"], "line": [8, "ours"], "often": [60000, "ours"]}, "read_latency": "one",
                   "write_latency": "one", "burst": "line", "refresh_interval": "often", "constraints": constraints}, out)


def build(folder):
    """{(loop, iterations): its program}, in \\p folder."""
    start = kernels.assembled(folder, os.path.join(HERE, "kernels", "start.s"))
    programs = {}
    for loop in l2_loops.LOOPS:
        for iterations in l2_loops.ITERATIONS:
            name = f"{loop}.{iterations}"
            source = os.path.join(folder, name + ".s")
            with open(source, "w") as file:
                file.write(l2_loops.text(loop, iterations))
            programs[loop, iterations] = kernels.linked([start, kernels.assembled(folder, source)],
                                                        os.path.join(folder, name + ".elf"))
    return programs


class Machine:
    """Our core with one of OURS behind it."""

    def __init__(self, changes, memory):
        self.changes = ("timing.socket.icache_kib=16", "timing.core.interleaved_stacks=0", f"timing.dram.standard={memory}", *MEMORY,
                        *changes)
        self.names = []

    def cycles(self, program, dcache_kib=16):
        time = cores.time_of(program, PRESET, 1, (*self.changes, f"timing.core.dcache_kib={dcache_kib}"))
        self.names.append(clocked.name(time))
        return time["cycles"]

    def of_iteration(self, programs, loop):
        few, many = (self.cycles(programs[loop, iterations]) for iterations in l2_loops.ITERATIONS)
        return (many - few) / (l2_loops.ITERATIONS[1] - l2_loops.ITERATIONS[0])


def table_of_loops(references, programs, machines):
    print(f"\n`{PRESET}` with an L2 beside `{references['name']}`, cycles of an access:\n")
    print("| loop | RTL without L2 | RTL | ours as it is | error | ours with the RTL's values | error |\n|---|--:|--:|--:|--:|--:|--:|")
    wrong = []
    for loop, reference in references["loops"].items():
        if another := kernels.another_image(programs[loop, l2_loops.ITERATIONS[1]], reference):
            wrong.append(f"{loop}: {another}")
            continue
        theirs, accesses = reference["cycles_per_iteration"], l2_loops.accesses(loop)
        cells = []
        for machine in machines:
            ours = machine.of_iteration(programs, loop)
            error = ours / theirs - 1
            cells += [f"{ours / accesses:.1f}", f"{100 * error:+.1f} %"]
        print(f"| `{loop}` | {reference['without_l2'] / accesses:.1f} | {theirs / accesses:.1f} | {' | '.join(cells)} |")
        if loop not in NOT_COMPARABLE and abs(error) > cores.LIMIT:
            wrong.append(f"{loop}: {ours / accesses:.1f} cycles, expected {theirs / accesses:.1f} within {100 * cores.LIMIT:.0f} %")
    return wrong


def table_of_kernels(name, run, programs, machines):
    programs = {kernel: programs[kernel] for kernel in run["kernels"] if kernel in programs}
    if not programs:
        return []
    print(f"\n`{PRESET}` with an L2 beside `{name}`, data cache of {run['dcache_kib']} KiB, cycles of a whole kernel:\n")
    print("| kernel | RTL | ours as it is | error | ours with the RTL's values | error |\n|---|--:|--:|--:|--:|--:|")
    wrong, ratios = [], []
    for kernel, program in programs.items():
        reference = run["kernels"][kernel]
        if another := kernels.another_image(program, reference):
            wrong.append(f"{kernel}: {another}")
            continue
        theirs = reference["cycles"]
        ours = [machine.cycles(program, run["dcache_kib"]) for machine in machines]
        ratios.append([cycles / theirs for cycles in ours])
        cells = " | ".join(f"{cycles} | {100 * (cycles / theirs - 1):+.1f} %" for cycles in ours)
        print(f"| `{kernel}` | {theirs} | {cells} |")
        if abs(ratios[-1][-1] - 1) > kernels.OF_ONE:
            wrong.append(f"{kernel}: {ours[-1]} cycles, expected {theirs} within {100 * kernels.OF_ONE:.0f} %")
    if len(ratios) == len(run["kernels"]):
        means = [math.exp(sum(map(math.log, column)) / len(ratios)) for column in zip(*ratios, strict=True)]
        print(f"| geometric mean | | {' | '.join(f'| {100 * (mean - 1):+.1f} %' for mean in means)} |")
        if abs(means[-1] - 1) > kernels.OF_ALL:
            wrong.append(f"geometric mean {means[-1]:.3f}, expected 1 within {100 * kernels.OF_ALL:.0f} %")
    return wrong


def main():
    with open(os.path.join(HERE, "l2_references.json")) as file:
        references = json.load(file)
    there = references["kernels"][0]["kernels"]
    args = kernels.arguments(__doc__, there)
    with tempfile.TemporaryDirectory() as temporary:
        folder = args.write or temporary
        os.makedirs(folder, exist_ok=True)
        of_loops, of_kernels = build(folder), kernels.build(folder, args.kernels or there)
        if args.peer:
            references = peers.figures(args.peer, dict, folder)
        memory = os.path.join(folder, "memory.json")
        memory_table(memory)
        machines = [Machine(changes, memory) for changes in OURS]
        wrong = table_of_loops(references, of_loops, machines)
        for run in references["kernels"]:
            wrong += table_of_kernels(references["name"], run, of_kernels, machines)
    clocked.say([name for machine in machines for name in machine.names])
    for line in wrong:
        print(f"l2.py: error: {line}", file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    command_line.run(main)
