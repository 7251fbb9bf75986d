#!/usr/bin/env python3
"""Runs CoreMark (https://github.com/eembc/coremark) on the machine and under qemu-riscv32, and compares what they report.

usage: bench/coremark.py FOLDER [--iterations N] [--levels=-O0,-O2,...]

FOLDER is a copy of CoreMark's repository; it is built there, with the port of bench/coremark. With the same number of
iterations both must find the same checksums. With --iterations 0 CoreMark finds a number for a run of ten seconds, as its
rules ask, and validates its results (minutes).

exit codes: 0 the checksums are the same, 1 they are not, 2 usage, 3 CoreMark cannot be built or run
"""

import argparse
import os
import re
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
CHECKSUM = re.compile(r"^(?:\[0\])?((?:seed)?crc\w*) *: (0x\w+)$", re.M)


class Problem(Exception):
    """CoreMark cannot be built or run."""


def report(folder, target, level, iterations):
    """What CoreMark prints."""
    for name in ("coremark.elf", "coremark.linux", "run1.log"):
        path = os.path.join(folder, name)
        if os.path.exists(path):
            os.remove(path)
    command = ["make", "-s", f"PORT_DIR={os.path.join(ROOT, 'bench', 'coremark')}", f"TARGET={target}", f"LEVEL={level}",
               f"ITERATIONS={iterations}", "run1.log"]
    made = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    if made.returncode:
        raise Problem(f"{target} {level}: {(made.stderr or made.stdout).strip().splitlines()[-1]}")
    with open(os.path.join(folder, "run1.log"), encoding="utf-8") as log:
        return log.read()


def field(text, name):
    found = re.search(rf"^{name} *: (.+)$", text, re.M)
    return found.group(1) if found else "none"


def checksums(text, iterations):
    """By name. The last one depends on how many iterations there were."""
    found = dict(CHECKSUM.findall(text))
    if not iterations:
        found.pop("crcfinal", None)
    return found


def main():
    parser = argparse.ArgumentParser(prog="coremark.py", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", metavar="FOLDER")
    parser.add_argument("--iterations", type=int, default=20, metavar="N", help="0: as many as take ten seconds (default: 20)")
    parser.add_argument("--levels", default="-O2", help="options of the compilers (default: -O2)")
    args = parser.parse_args()
    if not os.path.exists(os.path.join(args.folder, "core_main.c")):
        print(f"coremark.py: error: {args.folder}: no core_main.c, expected a copy of CoreMark's repository", file=sys.stderr)
        return 3
    same = True
    print("| level | on | iterations | ticks an iteration | iterations a second | checksums | CoreMark says |\n|---|---|--:|--:|--:|---|---|")
    try:
        for level in args.levels.split(","):
            found = {}
            for target in ("vorion", "qemu"):
                text = report(args.folder, target, level, args.iterations)
                found[target] = checksums(text, args.iterations)
                count = int(field(text, "Iterations"))
                verdict = next((line.split(". ")[0] for line in text.splitlines() if line.startswith("Correct operation")), "no valid run")
                print(f"| {level} | {target} | {count} | {int(field(text, 'Total ticks')) // count} | {field(text, 'Iterations/Sec')} | "
                      f"{' '.join(found[target].values())} | {verdict} |", flush=True)
            same &= len(found["vorion"]) >= 4 and found["vorion"] == found["qemu"]
    except Problem as problem:
        print(f"coremark.py: error: {problem}", file=sys.stderr)
        return 3
    print("the checksums are " + ("the same" if same else "not the same"))
    return 0 if same else 1


if __name__ == "__main__":
    sys.exit(main())
