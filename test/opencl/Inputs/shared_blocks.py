#!/usr/bin/env python3
"""Runs the kernels of shared_blocks.cl on one warp: shared_blocks.py FOLDER.

A block that several paths reach is executed once: a kernel takes at most 1.3 times the warp instructions of the one whose
lanes all take one path, for each time that its loop runs. Results are those of the compiler without hubs.
"""

import json
import os
import struct
import subprocess
import sys

SOURCE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "shared_blocks.cl")
KERNELS = ("once", "either", "both", "default_case", "fall_through", "jump", "early_return", "from_loops", "in_loop")
# How often the loop runs. from_loops has loops of its own, too.
TIMES = {"in_loop": 2, "from_loops": 1.4}


def run(folder, program, kernel):
    out, stats = (os.path.join(folder, name) for name in ("out.bin", "stats.json"))
    subprocess.run(["vorion-sim", program, "--kernel", kernel, "--global", "16", "--local", "16", "--arg", f"out:64@{out}",
                    "--arg", f"buf@{folder}/in.bin", "--stats", stats], check=True, stdout=subprocess.DEVNULL)
    with open(out, "rb") as words, open(stats, encoding="utf-8") as file:
        return words.read(), json.load(file)["total"]["warp_instructions"]


def main(folder):
    with open(os.path.join(folder, "in.bin"), "wb") as file:
        file.write(struct.pack("<16i", *range(16)))
    programs = {}
    for name, options in (("with", []), ("without", ["-mllvm", "-vorion-reconverge=false"])):
        programs[name] = os.path.join(folder, f"{name}.elf")
        subprocess.run(["vorion-clang", "-O2", *options, SOURCE, "-o", programs[name]], check=True)
    _, once = run(folder, programs["with"], "once")
    failed = False
    for kernel in KERNELS:
        result, warp = run(folder, programs["with"], kernel)
        expected, before = run(folder, programs["without"], kernel)
        good = result == expected and warp <= 1.3 * once * TIMES.get(kernel, 1)
        print(f"{kernel}: {warp} warp instructions, {before} without hubs, {'same' if result == expected else 'other'} results"
              f"{'' if good else ': WRONG'}")
        failed |= not good
    return failed


sys.exit(main(sys.argv[1]))
