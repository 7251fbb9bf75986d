#!/usr/bin/env python3
"""Operations with one constant operand, compared with Python's integers.

A seed is an operation, a width and what the instruction selection may know of the constant. Its functions have a constant each,
most of them near powers of two or sums of two, since it is there that a compiler replaces an operation by others. An opaque
constant is one that LLVM's constant hoisting keeps in one place for several uses: most replacements then do not take place,
and those that do are hardly tested elsewhere. They are written as LLVM's code, because C gives no way to ask for one.

exit codes: 0 no difference, 1 a function differs or is refused (the seed's files are kept), 2 usage
"""

import math
import os
import random
import struct
import sys

import seeds
from machines import CONFIGURATIONS, Device, Refused, Wrong, failure, run

LANES = 16
WIDTHS = [32, 64, 16, 8]
FUNCTIONS = 120


def signed(value, width):
    return value - (1 << width) if value >> (width - 1) else value


def quotient(a, b):
    """Rounded to zero, as LLVM's division."""
    return abs(a) // abs(b) * (1 if (a < 0) == (b < 0) else -1)


def on_signed(compute):
    return lambda a, b, width: compute(signed(a, width), signed(b, width))


FIRST = "constant "  # begins the names of operations whose first operand is the constant

# What each operation gives of (value, constant, width), both as numbers without sign; None where it is undefined.
OPERATIONS = {
    "mul": lambda a, b, _: a * b,
    "add": lambda a, b, _: a + b,
    "sub": lambda a, b, _: a - b,
    "and": lambda a, b, _: a & b,
    "or": lambda a, b, _: a | b,
    "xor": lambda a, b, _: a ^ b,
    "udiv": lambda a, b, _: a // b if b else None,
    "urem": lambda a, b, _: a % b if b else None,
    "sdiv": on_signed(lambda a, b: quotient(a, b) if b else None),
    "srem": on_signed(lambda a, b: a - b * quotient(a, b) if b else None),
    "icmp ult": lambda a, b, _: a < b,
    "icmp eq": lambda a, b, _: a == b,
    "icmp sgt": on_signed(lambda a, b: a > b),
    FIRST + "sub": lambda a, b, _: b - a,
    FIRST + "udiv": lambda a, b, _: b // a if a else None,
    FIRST + "shl": lambda a, b, width: b << a if a < width else None,
    FIRST + "lshr": lambda a, b, width: b >> a if a < width else None,
    FIRST + "ashr": lambda a, b, width: signed(b, width) >> a if a < width else None,
}
KINDS = [(operation, width, opaque) for operation in OPERATIONS for width in WIDTHS for opaque in (True, False)]


def constants(rng, width):
    """FUNCTIONS numbers of that width."""
    def one():
        shape = rng.randrange(6)
        a, b = rng.randrange(width), rng.randrange(width)
        number = [1 << a, (1 << a) - (1 << b), (1 << a) + (1 << b), rng.choice([3, 5, 9, 15, 25, 45]) << a,
                  (1 << a) + rng.randint(-10, 10), rng.getrandbits(width)][shape]
        return number * rng.choice([1, -1]) % (1 << width)
    return [one() for _ in range(FUNCTIONS)]


def values(rng, width):
    """LANES of them, as 64 bits that hold garbage above the width."""
    special = [0, 1, -1, 1 << (width - 1), (1 << (width - 1)) - 1, 3, -7, width - 1, rng.randrange(width)]
    chosen = [value % (1 << width) for value in special] + [rng.getrandbits(width) for _ in range(LANES - len(special))]
    return [value | rng.getrandbits(64) >> width << width & (1 << 64) - 1 for value in chosen]


def function(number, kind, constant):
    operation, width, opaque = kind
    operand = "%k" if opaque else constant
    compare = operation.startswith("icmp")
    lines = [f"define i64 @f{number}(i64 %x) {{"]
    lines += [f"  %k = bitcast i{width} {constant} to i{width}"] if opaque else []
    value = "%x"
    if width < 64:
        lines.append(f"  %v = trunc i64 %x to i{width}")
        value = "%v"
    operands = (operand, value) if operation.startswith(FIRST) else (value, operand)
    lines.append(f"  %r = {operation.removeprefix(FIRST)} i{width} {operands[0]}, {operands[1]}")
    result = "%r"
    if compare or width < 64:
        lines.append(f"  %z = zext i{1 if compare else width} %r to i64")
        result = "%z"
    return "\n".join(lines + [f"  ret i64 {result}", "}", ""])


def kernel():
    """Calls every function with a lane's own value, which `out` holds, and puts its results behind all values."""
    declarations = "".join(f"ulong f{number}(ulong);\n" for number in range(FUNCTIONS))
    calls = "".join(f"  to[{number}] = f{number}(x);\n" for number in range(FUNCTIONS))
    return (f'#include "kernels.h"\n{declarations}'
            "static void run_kernels(uint *out, uint *local, uint n, uint lanes, uint number) {\n"
            f"  ulong x = ((ulong *)out)[LANE], *to = (ulong *)out + LANES + LANE * {FUNCTIONS};\n{calls}}}\n"
            f"enum {{ LANES = {LANES} }};\n"
            '#include "entry.h"\n').replace("+ LANES", f"+ {LANES}")


def check(seed, folder):
    kind = KINDS[seed % len(KINDS)]
    operation, width, opaque = kind
    configuration = CONFIGURATIONS[seed // len(KINDS) % len(CONFIGURATIONS)]
    rng = random.Random(seed)
    chosen, given = constants(rng, width), values(rng, width)
    base = os.path.join(folder, "operands")
    with open(base + ".ll", "w", encoding="utf-8") as file:
        file.writelines(function(number, kind, constant) for number, constant in enumerate(chosen))
    with open(base + ".c", "w", encoding="utf-8") as file:
        file.write(kernel())
    title = f"{operation} i{width}{', opaque' * opaque}, {configuration}"
    try:
        built = run(["vorion-llc", "-mtriple=riscv32", "-target-abi=ilp32f", f"-mattr={configuration.attributes()}", "-filetype=obj",
                     base + ".ll", "-o", base + ".o"])
        if built.returncode:
            raise Refused(failure(built))
        device = Device()
        elf = device.compile(base + ".c", base, configuration, [base + ".o"])
        start = struct.pack(f"<{LANES}Q", *given) + bytes(8 * LANES * FUNCTIONS)
        got = struct.unpack(f"<{LANES * (1 + FUNCTIONS)}Q", device.run(elf, base, 1, LANES, ["u32:0", f"u32:{LANES}", "local:256"], start))
    except (Refused, Wrong) as problem:
        return {"seed": seed, "counts": {"bad": FUNCTIONS}, "bad": [f"{title}: {type(problem).__name__.lower()}: {problem}"]}
    bad, compute = [], OPERATIONS[operation]
    for number, constant in enumerate(chosen):
        for lane, value in enumerate(given):
            wanted = compute(value % (1 << width), constant, width)
            result = got[LANES + lane * FUNCTIONS + number]
            if wanted is not None and result != int(wanted) % (1 << width):
                bad.append(f"{title}: {value % (1 << width):#x} and {constant:#x} give {result:#x}, expected {int(wanted) % (1 << width):#x}")
                break
    return {"seed": seed, "counts": {"same": FUNCTIONS - len(bad), "bad": len(bad)}, "bad": bad}


def main():
    parser = seeds.options(__doc__, "constant-operands", "functions")
    chosen = parser.parse_args()
    os.makedirs(chosen.folder, exist_ok=True)
    todo = range(chosen.first, chosen.first + math.ceil(chosen.count / FUNCTIONS))
    counts, bad_seeds, spent = seeds.check_all(chosen, todo, check)
    print(f"seeds {todo[0]} to {todo[-1]}: {counts['same']} functions same, {counts['bad']} bad, in {bad_seeds} of {len(todo)} seeds; {spent}")
    return 1 if bad_seeds else 0


if __name__ == "__main__":
    sys.exit(main())
