#!/usr/bin/env python3
"""The clock's cores beside references, loop by loop, as Markdown tables.

usage: cores.py REFERENCES [--peer PROGRAM]

REFERENCES is a folder with vortex_core_cpi.json and vortex_more.json: small loops as assembly, and the cycles of an
iteration on Vortex's RTL. A loop is run twice, and the difference divided by that of the iterations, so that
beginning and end cancel. A reference's loops that it does not call comparable are shown without an error. PROGRAM is called
with the folder and prints what vortex_more.json has; its machines take the place of those of the same name. The exit code is 1
if a comparable loop is off by more than 5 %.
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile

sys.path.append(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
import clocked
import command_line
import peers

LIMIT = 0.05
# What our machine is set to for each reference, and how many warps run the loop. The RTLs have data caches.
MACHINES = (
    ("rtl_2025_09", "vortex-2025", 1),
    ("rtl_2025_09_2_warps", "vortex-2025", 2),
    ("rtl_2025_09_4_warps", "vortex-2025", 4),
    ("rtl_2023_05_v1", "vortex-5stage", 1),
)
# Not comparable where the file has no word on it: DRAM decides, or the reference has no atomics.
NOT_COMPARABLE = ("ld_stream", "amo_same", "amo_diff")

# Starts all warps of the core in the loop, which the file calls main.
ALL_WARPS = """
  .globl main
main:
  mv s10, ra
  csrr t0, vx_num_warps
  la t1, 1f
  vx_wspawn t0, t1
1:
  li t0, -1
  vx_tmc t0
  call loop
  csrr t0, vx_warp_id
  beqz t0, 2f
  vx_tmc zero
2:
  mv ra, s10
  li a0, 0
  ret
"""


def references(folder, peer=None):
    """(kernels by name, {machine: {kernel: (cycles of an iteration, comparable)}})."""
    with open(os.path.join(folder, "vortex_core_cpi.json")) as file:
        kernels = {k["name"]: k for k in json.load(file)["kernels"]}
    machines = {}
    for name, kernel in kernels.items():
        for machine, cycles in kernel["cycles_per_iteration"].items():
            machines.setdefault(machine, {})[name] = (cycles, name not in NOT_COMPARABLE)
    with open(os.path.join(folder, "vortex_more.json")) as file:
        more = json.load(file)
    for machine in more + (peers.figures(peer, list, folder) if peer else []):
        machines[machine["name"]] = {r["kernel"]: (r["cycles_per_iteration"], r["comparable"])
                                     for r in machine["results"]}
    return kernels, machines


def assemble(folder, kernel, iterations):
    """The program that runs a loop so often, on as many warps as a core has."""
    stem = os.path.join(folder, f"{kernel['name']}.{iterations}")
    if not os.path.exists(stem + ".elf"):
        loop = kernel["assembly"].replace("ITERS", str(iterations))
        loop = loop.replace(".globl main", "").replace("main:", "loop:")
        with open(stem + ".s", "w") as file:
            file.write(ALL_WARPS + loop)
        subprocess.run(["vorion-clang", "-o", stem + ".elf", stem + ".s"], check=True)
    return stem + ".elf"


def time_of(program, preset, warps, changes=(), options=()):
    """The time report of one core of a preset with a data cache, as the RTLs have, and what else is changed."""
    settings = ("machine=prototype-on-chip", "sockets_per_cluster=1", "cores_per_socket=1", f"warps_per_core={warps}",
                f"timing.core.preset={preset}", "timing.core.dcache_kib=16", *changes)
    report = program + ".json"
    done = subprocess.run(["vorion-sim", program, "--set", "host_threads=1", "--set", ",".join(settings), "--time", "--stats", report, *options],
                          stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    if done.returncode:
        sys.exit(done.stderr)  # else it has notes on settings that are the machine's anyway
    with open(report) as file:
        return json.load(file)["runs"][0]["time"]


def per_iteration(folder, kernel, preset, warps, changes=()):
    """(cycles, the machine's name)."""
    few, many = kernel["iterations"]
    took = [time_of(assemble(folder, kernel, n), preset, warps, changes) for n in (few, many)]
    return (took[1]["cycles"] - took[0]["cycles"]) / (many - few), clocked.name(took[1])


def table(folder, kernels, name, reference, preset, warps):
    """Prints one machine's rows; returns what is too far off."""
    print(f"\n`{preset}` beside `{name}`, {warps} warp{'s' if warps > 1 else ''}, cycles of an iteration:\n")
    print("| loop | ours | reference | error |\n|---|--:|--:|--:|")
    wrong, names = [], []
    for loop, (theirs, comparable) in reference.items():
        if theirs is None or loop not in kernels:
            continue
        ours, machine = per_iteration(folder, kernels[loop], preset, warps)
        names.append(machine)
        error = ours / theirs - 1
        print(f"| `{loop}` | {ours:.1f} | {theirs:.1f} | {f'{100 * error:+.1f} %' if comparable else 'not comparable'} |")
        if comparable and abs(error) > LIMIT:
            wrong.append(f"{name}: {loop}: {ours:.1f} cycles, expected {theirs:.1f} within {100 * LIMIT:.0f} %")
    if names:
        clocked.say(names)
    return wrong


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("references")
    peers.add(parser)
    args = parser.parse_args()
    kernels, machines = references(args.references, args.peer)
    wrong = []
    with tempfile.TemporaryDirectory() as folder:
        for name, preset, warps in MACHINES:
            if name in machines:
                wrong += table(folder, kernels, name, machines[name], preset, warps)
    for line in wrong:
        print(f"cores.py: error: {line}", file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    command_line.run(main)
