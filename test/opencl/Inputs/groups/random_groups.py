#!/usr/bin/env python3
"""Random OpenCL kernels with barriers, in groups of 1 to 64 work-items, compared with a host model.

A seed is a file of 6 kernels (group_kernel.py): barriers in straight code, in loops and in conditionals, with values that
live across them. vorion-clang compiles it, vorion-sim runs each kernel with each group size; on the host each
work-item is a coroutine (group_host.h). All words of the output must be the same.

exit codes: 0 no difference, 1 a kernel differs or is refused (the seed's files are kept), 2 usage
"""

import functools
import math
import os
import struct
import sys

INPUTS = os.path.dirname(os.path.abspath(__file__))
sys.path.append(os.path.join(INPUTS, *[os.pardir] * 3, "codegen", "Inputs", "kernels"))
import seeds  # noqa: E402
from group_kernel import FORMS, GROUPS, LOCAL_WORDS, Program  # noqa: E402
from machines import failure, run  # noqa: E402

KERNELS = 6


def expected(program, folder):
    """What the host's work-items leave, all runs one after the other."""
    source, binary = os.path.join(folder, "host.c"), os.path.join(folder, "host")
    with open(source, "w", encoding="utf-8") as file:
        file.write(program.host_source())
    built = run(["clang-19", "-w", "-O1", "-ffp-contract=off", f"-I{INPUTS}", source, "-o", binary])
    if built.returncode:
        raise RuntimeError(f"{source}: the host's compiler fails: {failure(built)}")
    with open(os.path.join(folder, "expected"), "wb") as file:
        ran = run([binary], stdout=file)
    if ran.returncode:
        raise RuntimeError(f"{binary}: {failure(ran)}")
    with open(file.name, "rb") as file:
        return file.read()


def check(kernels, forms, seed, folder):
    def at(name):
        return os.path.join(folder, name)
    program = Program(seed, kernels, forms)
    want = expected(program, folder)
    with open(at("kernels.cl"), "w", encoding="utf-8") as file:
        file.write(program.text)
    with open(at("in"), "wb") as file:
        file.write(struct.pack(f"<{len(program.input)}I", *program.input))
    built = run(["vorion-clang", "-w", at("kernels.cl"), "-o", at("kernels.elf")])
    if built.returncode:
        return {"seed": seed, "counts": {"bad": kernels}, "bad": [f"refused: {failure(built)}"]}
    bad = []
    for name, size in program.runs():
        share, want = want[:4 * program.out_words(size)], want[4 * program.out_words(size):]
        command = ["vorion-sim", "--set", "host_threads=1", "--set", "max_instructions=20000000", at("kernels.elf"), "--kernel", name,
                   "--global", str(GROUPS * size), "--local", str(size), "--arg", f"out:{len(share)}@{at('out')}",
                   "--arg", f"buf@{at('in')}", "--arg", f"local:{4 * LOCAL_WORDS * size}", "--arg", f"u32:{program.argument}"]
        ran = run(command)
        if ran.returncode:
            bad.append(f"{name}, groups of {size}: {failure(ran)}")
            continue
        with open(at("out"), "rb") as file:
            if file.read() != share:
                bad.append(f"{name}, groups of {size}: wrong; {' '.join(command)}")
    return {"seed": seed, "counts": {"runs": len(program.runs()) - len(bad), "bad": len(bad)}, "bad": bad}


def main():
    parser = seeds.options(__doc__, "random-groups", "kernels")
    for form, text in FORMS.items():
        parser.add_argument(f"--{form}", action="append_const", dest="forms", const=form, default=[], help=f"also {text}")
    chosen = parser.parse_args()
    todo = range(chosen.first, chosen.first + math.ceil(chosen.count / KERNELS))
    counts, bad_seeds, spent = seeds.check_all(chosen, todo, functools.partial(check, KERNELS, chosen.forms))
    print(f"seeds {todo[0]} to {todo[-1]}: {len(todo) * KERNELS} kernels, {counts['runs']} runs same, {counts['bad']} bad, "
          f"in {bad_seeds} of {len(todo)} seeds; {spent}")
    return 1 if bad_seeds else 0


if __name__ == "__main__":
    sys.exit(main())
