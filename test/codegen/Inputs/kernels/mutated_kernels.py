#!/usr/bin/env python3
"""A test of the tests: do the random kernels notice when divergence is lowered wrongly?

Compiles random kernels to assembly, one at a time, makes one kind of mistake throughout it, which no verifier of the
compiler sees any more, runs the result and compares it as random_kernels.py does.

exit codes: 0 each mistake is noticed by a kernel at least and unchanged code is right, 1 otherwise, 2 usage
"""

import argparse
import os
import re
import sys
import tempfile

from machines import CONFIGURATIONS, Device, Linux, Wrong, failure, run
from module import Module
from random_kernels import execute

MAX_WARP_INSTRUCTIONS = 2_000_000  # a wrong mask may make a loop endless; a module takes a tenth
# What divergence lowering might do wrong: name, pattern of the end of a line, replacement.
MISTAKES = [
    # With the condition inverted the other side goes first, which is right, too.
    ("a split that does not see its condition", r"(vx_split(?:_n)?\t\w+), (?!zero)\w+$", r"\1, zero"),
    ("a join left out", r"vx_join\t\w+$", "nop"),
    ("the mask of a loop's lanes not restored", r"(vx_pred(?:_n)?)\t(\w+), (\w+)$", r"csrr\t\3, vx_active_threads\n\t\1\t\2, \3"),
]


def result(module, assembly, base):
    """What the program leaves; None if it does not end as it should."""
    source = base + ".s"
    with open(source, "w", encoding="utf-8") as file:
        file.write(assembly)
    linked = run(["vorion-clang", source, "-o", base + ".elf"])
    if linked.returncode:
        raise RuntimeError(f"{source}: {failure(linked)}")
    try:
        return execute(module, base + ".elf", base, MAX_WARP_INSTRUCTIONS)
    except Wrong:
        return None


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seed", type=int, default=1, help="of the module of kernels")
    parser.add_argument("--count", type=int, default=10, help="kernels to make mistakes in")
    chosen = parser.parse_args()
    counts = dict.fromkeys((name for name, _, _ in MISTAKES), 0)
    with tempfile.TemporaryDirectory() as folder:
        linux, base = Linux(folder), os.path.join(folder, "module")
        module = Module(chosen.seed, chosen.count, lanes=16)
        source = base + ".c"
        with open(source, "w", encoding="utf-8") as file:
            file.write(module.source())
        everything = linux.run(source, base)
        for only in range(chosen.count):
            configuration = CONFIGURATIONS[only * 7 % len(CONFIGURATIONS)]
            share = slice(only * module.out_bytes(), (only + 1) * module.out_bytes())
            compiled = Device().compile(source, base, configuration, ["-S", f"-DONLY={only}"], ".s")
            with open(compiled, encoding="utf-8") as file:
                assembly = file.read()

            def same(text, share=share):
                got = result(module, text, os.path.join(folder, "changed"))
                return got is not None and got[share] == everything[share]

            if not same(assembly):
                print(f"kernel {only} {configuration}: the unchanged program is wrong")
                return 1
            for name, pattern, replacement in MISTAKES:
                counts[name] += not same(re.sub(pattern, replacement, assembly, flags=re.M))
    for name, number in counts.items():
        print(f"{name}: noticed by {number} of {chosen.count} kernels")
    return 0 if all(counts.values()) else 1


if __name__ == "__main__":
    sys.exit(main())
