#!/usr/bin/env python3
"""Random kernels, compared lane by lane with the same C as a plain rv32 program.

A seed is a module of 25 kernels (module.py), compiled once for the device, with optimisation and extensions that change
from seed to seed, and once with the packaged clang for qemu-riscv32. Every word that a kernel leaves must be the same.

exit codes: 0 no difference, 1 a kernel differs or is refused (the seed's files are kept), 2 usage
"""

import functools
import math
import os
import sys

import seeds
from machines import CONFIGURATIONS, MAX_WARP_INSTRUCTIONS, Device, Linux, Refused, Wrong
from module import GROUPS, HALF_WORDS, Module

KERNELS = 25


def execute(module, program, base, most=MAX_WARP_INSTRUCTIONS):
    """What the module's program leaves on the device."""
    arguments = [f"u32:{module.argument}", f"u32:{module.lanes}", f"local:{2 * 4 * HALF_WORDS}"]
    return Device().run(program, base, GROUPS, module.lanes, arguments, module.out_start(), most)


def on_device(module, source, base, configuration, defines=()):
    return execute(module, Device().compile(source, base, configuration, defines), base)


LEVELS_DIFFER = "levels differ"


def judge(module, linux, source, base, configuration, expected, only):
    """What is wrong with one kernel alone; None if nothing is."""
    share = slice(only * module.out_bytes(), (only + 1) * module.out_bytes())
    try:
        got = on_device(module, source, f"{base}.{only}", configuration, [f"-DONLY={only}"])
    except (Refused, Wrong) as problem:
        return f"{type(problem).__name__.lower()}: {problem}"
    if got[share] == expected[share]:
        return None
    # Then the packaged clang is wrong, as with products with a constant of -2^M that is used twice (docs/backend.md, Patches).
    plain = linux.as_written(source, f"{base}.O0")
    if plain is not None and plain[share] == got[share]:
        return LEVELS_DIFFER
    word = next(i for i in range(0, module.out_bytes(), 4) if got[share][i:i + 4] != expected[share][i:i + 4])
    lane, word = divmod(word // 4, 32)
    return f"wrong: word {word} of lane {lane % module.lanes} of group {lane // module.lanes}"


def check(kernels, linux, seed, folder):
    module = Module(seed, kernels)
    configuration = CONFIGURATIONS[seed * 7 % len(CONFIGURATIONS)]  # 7: neighbours differ in level and extensions
    base = os.path.join(folder, "module")
    source = base + ".c"
    with open(source, "w", encoding="utf-8") as file:
        file.write(module.source())
    expected = linux.run(source, base)
    size, bad, suspects, differing = module.out_bytes(), [], range(kernels), 0
    try:
        got = on_device(module, source, base, configuration)
        suspects = [n for n in suspects if got[n * size:(n + 1) * size] != expected[n * size:(n + 1) * size]]
    except (Refused, Wrong) as problem:
        bad = [f"{configuration}: all: {type(problem).__name__.lower()}: {problem}"]
    if suspects:
        alone = {only: judge(module, linux, source, base, configuration, expected, only) for only in suspects}
        differing = list(alone.values()).count(LEVELS_DIFFER)
        found = [f"{configuration}: -DONLY={only}: {what}" for only, what in alone.items() if what not in (None, LEVELS_DIFFER)]
        if found or not differing:
            bad = found or bad or [f"{configuration}: wrong: kernels {suspects}, but not on their own"]
    counts = {str(configuration): kernels - len(bad) - differing, "bad": len(bad), LEVELS_DIFFER: differing}
    return {"seed": seed, "counts": counts, "bad": bad}


def main():
    parser = seeds.options(__doc__, "random-kernels", "kernels")
    chosen = parser.parse_args()
    os.makedirs(chosen.folder, exist_ok=True)
    todo = range(chosen.first, chosen.first + math.ceil(chosen.count / KERNELS))
    counts, bad_seeds, spent = seeds.check_all(chosen, todo, functools.partial(check, KERNELS, Linux(chosen.folder)))
    bad, differing = counts.pop("bad", 0), counts.pop(LEVELS_DIFFER, 0)
    for configuration in map(str, CONFIGURATIONS):
        if counts[configuration]:
            print(f"{counts[configuration]:6} same {configuration}")
    print(f"seeds {todo[0]} to {todo[-1]}: {counts.total()} kernels same, {bad} bad, in {bad_seeds} of {len(todo)} seeds, {differing} that "
          f"differ by level as a plain program; {spent}")
    return 1 if bad_seeds else 0


if __name__ == "__main__":
    sys.exit(main())
