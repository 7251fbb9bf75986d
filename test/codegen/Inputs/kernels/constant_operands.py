#!/usr/bin/env python3
"""Operations with one constant operand, compared with Python's integers.

A seed is an operation, a width and what the instruction selection may know of the constant. Its functions have a constant each,
most of them near powers of two or sums of two, since it is there that a compiler replaces an operation by others. An opaque
constant is one that LLVM's constant hoisting keeps in one place for several uses: most replacements then do not take place,
and those that do are hardly tested elsewhere. They are written as LLVM's code, because C gives no way to ask for one.

exit codes: 0 no difference, 1 a function differs or is refused (the seed's files are kept), 2 usage
"""

import random
import sys

import functions
from functions import quotient, signed

WIDTHS = [32, 64, 16, 8]
FUNCTIONS = 120


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


def check(seed, folder):
    kind = KINDS[seed % len(KINDS)]
    operation, width, opaque = kind
    configuration = functions.configuration_of(seed // len(KINDS))
    rng = random.Random(seed)
    chosen, given = [functions.constant(rng, width) for _ in range(FUNCTIONS)], functions.values(rng, width)
    text = "".join(function(number, kind, constant) for number, constant in enumerate(chosen))

    def difference(number, results):
        for value, result in zip(given, results):
            low, constant = value % (1 << width), chosen[number]
            wanted = OPERATIONS[operation](low, constant, width)
            if wanted is not None and result != int(wanted) % (1 << width):
                return f"{low:#x} and {constant:#x} give {result:#x}, expected {int(wanted) % (1 << width):#x}"
        return None

    return functions.check(seed, f"{operation} i{width}{', opaque' * opaque}, {configuration}", FUNCTIONS,
                           lambda: functions.compute(text, [(value,) for value in given], FUNCTIONS, folder, configuration), difference)


if __name__ == "__main__":
    sys.exit(functions.main(__doc__, "constant-operands", FUNCTIONS, check))
