#!/usr/bin/env python3
"""Writes references that bench/timing/vortex5.py reads, by a formula of the machine's own numbers.

usage: vortex5_references.py FOLDER

Independent additions take a fetch each. FOLDER gets two loops of them for one warp: `near` as the formula says, and `far`,
which is said to take a tenth less. known.json expects that of `far`, changed.json another error of it, and better.json an
error of `near`.
"""

import json
import os
import subprocess
import sys

ADDS = 40
START = """  .section .text.vorion_start, "ax", @progbits
  .globl _start
_start:
  li t0, -1
  vx_tmc t0
  call main
  vx_tmc zero
"""
LOOP = "  .globl main\nmain:\n  li s2, ITERS\n  .balign 64\n1:\n" + "".join(
    f"  add a{3 + n % 4}, a1, a2\n" for n in range(ADDS)) + "  addi s2, s2, -1\n  bnez s2, 1b\n  ret\n"


def main():
    folder = sys.argv[1]
    os.makedirs(os.path.join(folder, "vortex5_kernels"))

    def write(name, what):
        with open(os.path.join(folder, name), "w") as file:
            json.dump(what, file)

    def known(name, row, error):
        write(name, [{"references": "vortex5_warps.json", "row": row, "column": "1", "error_percent": error, "why": "a test"}])

    with open(os.path.join(folder, "vortex5_kernels", "start.s"), "w") as file:
        file.write(START)
    text = subprocess.run(["vorion-sim", "--set", "timing.core.preset=vortex-5stage", "--print-default-config"], check=True,
                          capture_output=True, text=True).stdout
    core = json.loads(text)["timing"]["core"]
    # What decrements waits for its turn, and the branch behind it.
    cycles = (ADDS + 1) * core["fetch_interval"] + core["branch_cycles"]
    write("vortex_core_cpi.json", {"kernels": []})
    write("vortex5_warps.json", {"kernels": [], "loops": [
        {"name": name, "assembly": LOOP, "iterations": [10, 30], "comparable": True, "cycles_per_iteration": {"1": cycles / times}}
        for name, times in (("near", 1), ("far", 1.1))]})
    known("known.json", "far", 10.0)
    known("changed.json", "far", 8.0)
    known("better.json", "near", 7.0)


main()
