"""Functions written as LLVM's code, run on the device with values of each lane's own."""

import math
import os
import struct

import seeds
from machines import CONFIGURATIONS, Device, Refused, Wrong, failure, run

LANES = 16


def signed(value, width):
    return value - (1 << width) if value >> (width - 1) else value


def quotient(a, b):
    """Rounded to zero, as LLVM's division."""
    return abs(a) // abs(b) * (1 if (a < 0) == (b < 0) else -1)


def constant(rng, width):
    """Most of them near powers of two or sums of two, since it is there that a compiler replaces an operation by others."""
    shape = rng.randrange(6)
    a, b = rng.randrange(width), rng.randrange(width)
    number = [1 << a, (1 << a) - (1 << b), (1 << a) + (1 << b), rng.choice([3, 5, 9, 15, 25, 45]) << a,
              (1 << a) + rng.randint(-10, 10), rng.getrandbits(width)][shape]
    return number * rng.choice([1, -1]) % (1 << width)


def values(rng, width):
    """LANES of them, as 64 bits that hold garbage above the width."""
    special = [0, 1, -1, 1 << (width - 1), (1 << (width - 1)) - 1, 3, -7, width - 1, rng.randrange(width)]
    chosen = [value % (1 << width) for value in special] + [rng.getrandbits(width) for _ in range(LANES - len(special))]
    return [value | rng.getrandbits(64) >> width << width & (1 << 64) - 1 for value in chosen]


def kernel(count, arguments):
    """Calls every function with a lane's own values, which `out` holds, and puts its results behind the values of all."""
    parameters = ", ".join(["ulong"] * arguments)
    given = ", ".join(f"x[{number}]" for number in range(arguments))
    declarations = "".join(f"ulong f{number}({parameters});\n" for number in range(count))
    calls = "".join(f"  to[{number}] = f{number}({given});\n" for number in range(count))
    return (f'#include "kernels.h"\n{declarations}'
            "static void run_kernels(uint *out, uint *local, uint n, uint lanes, uint number) {\n"
            f"  ulong x[] = {{{', '.join(f'((ulong *)out)[LANE * {arguments} + {number}]' for number in range(arguments))}}};\n"
            f"  ulong *to = (ulong *)out + {LANES * arguments} + LANE * {count};\n{calls}}}\n"
            f"enum {{ LANES = {LANES} }};\n"
            '#include "entry.h"\n')


def compute(text, given, count, folder, configuration, before=()):
    """For each lane what `text`'s functions @f0 to @f(count - 1) return, given the lane's values of 64 bits. `before` are passes of
    LLVM's optimiser that go first. Raises Refused and Wrong; files stay in the folder."""
    base, arguments = os.path.join(folder, "functions"), len(given[0])
    with open(base + ".ll", "w", encoding="utf-8") as file:
        file.write(text)
    with open(base + ".c", "w", encoding="utf-8") as file:
        file.write(kernel(count, arguments))
    source = base + ".ll"
    if before:
        source = base + ".opt.ll"
        passed = run(["opt-19", "-S", *before, base + ".ll", "-o", source])
        if passed.returncode:
            raise RuntimeError(f"the packaged optimiser fails: {failure(passed)}")
    level = configuration.level.replace("s", "2")  # llc has no -Os
    built = run(["vorion-llc", level, "-mtriple=riscv32", "-target-abi=ilp32f", f"-mattr={configuration.attributes()}", "-filetype=obj",
                 source, "-o", base + ".o"])
    if built.returncode:
        raise Refused(failure(built))
    device, words = Device(), [value for lane in given for value in lane]
    elf = device.compile(base + ".c", base, configuration, [base + ".o"])
    start = struct.pack(f"<{len(words)}Q", *words) + bytes(8 * LANES * count)
    got = device.run(elf, base, 1, LANES, ["u32:0", f"u32:{LANES}", "local:256"], start)
    results = struct.unpack(f"<{LANES * count}Q", got[8 * len(words):])
    return [results[lane * count:(lane + 1) * count] for lane in range(LANES)]


def configuration_of(number):
    return CONFIGURATIONS[number % len(CONFIGURATIONS)]


def check(seed, title, count, work, difference):
    """A seed's result for seeds.check_all. work() is compute(...); difference(function, lanes' results) is None or a line."""
    try:
        lanes = work()
    except (Refused, Wrong) as problem:
        return {"seed": seed, "counts": {"bad": count}, "bad": [f"{title}: {type(problem).__name__.lower()}: {problem}"]}
    bad = [line for number in range(count) if (line := difference(number, [lane[number] for lane in lanes]))]
    return {"seed": seed, "counts": {"same": count - len(bad), "bad": len(bad)}, "bad": [f"{title}: {line}" for line in bad]}


def main(description, name, per_seed, check_seed):
    """The program whose seeds, of so many functions each, check_seed(seed, folder) checks; its exit code."""
    chosen = seeds.options(description, name, "functions").parse_args()
    todo = range(chosen.first, chosen.first + math.ceil(chosen.count / per_seed))
    counts, bad_seeds, spent = seeds.check_all(chosen, todo, check_seed)
    print(f"seeds {todo[0]} to {todo[-1]}: {counts['same']} functions same, {counts['bad']} bad, in {bad_seeds} of {len(todo)} seeds; {spent}")
    return 1 if bad_seeds else 0
