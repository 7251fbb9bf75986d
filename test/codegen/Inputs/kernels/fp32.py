"""Numbers of 32 bits as LLVM's operations on float give them, each as a Python number; rounded once, to nearest, ties to even."""

import math
import struct
from fractions import Fraction

LARGEST = (2 - 2.0**-23) * 2.0**127


def bits(number):
    return struct.unpack("<I", struct.pack("<f", number))[0]


def of_bits(word):
    return struct.unpack("<f", struct.pack("<I", word))[0]


def text(number):
    """As LLVM's code has it: the bits of a double."""
    return f"0x{struct.unpack('<Q', struct.pack('<d', number))[0]:016X}"


def nearest(number):
    """Of an int, a Fraction, or a Python number that is exact or rounded so finely that a second rounding does not matter."""
    if isinstance(number, float) and (number == 0 or not math.isfinite(number)):
        return number
    exact = Fraction(number)
    if exact == 0:
        return 0.0
    # The place of the last bit: 23 below the first, but not below the least number.
    size = abs(exact)
    exponent = size.numerator.bit_length() - size.denominator.bit_length()
    exponent -= size < Fraction(2)**exponent
    last = Fraction(2)**max(exponent - 23, -149)
    result = round(size / last) * last  # Python's round takes ties to even
    return math.copysign(math.inf if result > LARGEST else float(result), -1 if exact < 0 else 1)


def divide(a, b):
    if math.isnan(a) or math.isnan(b) or (a == 0 and b == 0) or (math.isinf(a) and math.isinf(b)):
        return math.nan
    sign = math.copysign(1, a) * math.copysign(1, b)
    if b == 0 or math.isinf(a):
        return sign * math.inf
    if a == 0 or math.isinf(b):
        return sign * 0.0
    return nearest(Fraction(a) / Fraction(b))


def add(a, b):
    total = a + b
    if total == 0 or not math.isfinite(total):
        return total
    return nearest(Fraction(a) + Fraction(b))


def fused(a, b, c):
    return add(a * b, c)  # the product of two such numbers is exact in Python's


def square_root(a):
    return math.nan if a < 0 else a if a == 0 or not math.isfinite(a) else nearest(math.sqrt(a))


def whole(compute):
    """With the sign of what was rounded, also where that gives zero."""
    return lambda a: math.copysign(compute(a), a) if math.isfinite(a) else a


def half_away(a):
    return math.floor(abs(a) + 0.5)  # exact: a number with a fraction has 24 bits of 53


def least(a, b):
    """Of zeros the negative one; NaN where one is."""
    if math.isnan(a) or math.isnan(b):
        return math.nan
    return min((a, b), key=lambda number: (number, math.copysign(1, number)))


def greatest(a, b):
    if math.isnan(a) or math.isnan(b):
        return math.nan
    return max((a, b), key=lambda number: (number, math.copysign(1, number)))


OPERATIONS = {  # with the number of operands
    "fadd": (add, 2),
    "fsub": (lambda a, b: add(a, -b), 2),
    "fmul": (lambda a, b: nearest(a * b), 2),
    "fdiv": (divide, 2),
    "fneg": (lambda a: -a, 1),
    "@llvm.fabs": (abs, 1),
    "@llvm.copysign": (math.copysign, 2),
    "@llvm.fma": (fused, 3),
    "@llvm.sqrt": (square_root, 1),
    "@llvm.floor": (whole(math.floor), 1),
    "@llvm.ceil": (whole(math.ceil), 1),
    "@llvm.trunc": (whole(math.trunc), 1),
    "@llvm.rint": (whole(round), 1),
    "@llvm.roundeven": (whole(round), 1),
    "@llvm.round": (whole(half_away), 1),
    "@llvm.minimum": (least, 2),
    "@llvm.maximum": (greatest, 2),
}
