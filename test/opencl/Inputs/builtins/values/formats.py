"""The element types of OpenCL C, and exact numbers rounded to them."""

import math
import re
from fractions import Fraction

import numpy as np

INFINITY, NAN = math.inf, math.nan
# Names of rounding modes as conversions spell them.
NEAREST, TO_ZERO, UP, DOWN = "rte", "rtz", "rtp", "rtn"


class Whole:
    """A type of whole numbers. Values are Python's."""

    real = False

    def __init__(self, name, bits, signed):
        self.name, self.bits, self.signed = name, bits, signed
        self.least = -(1 << bits - 1) if signed else 0
        self.most = (1 << bits - signed) - 1
        self.storage = np.dtype(f"{'i' if signed else 'u'}{bits // 8}")

    def wrapped(self, value):
        """The value of its lowest bits."""
        value &= (1 << self.bits) - 1
        return value - (1 << self.bits) if value > self.most else value

    def clamped(self, value):
        return min(max(value, self.least), self.most)

    def pattern(self, value):
        return value & (1 << self.bits) - 1

    def of_pattern(self, pattern):
        return self.wrapped(pattern)


class Real:
    """A type of floating point. Values are Python's floats, which hold all of them."""

    real = True

    def __init__(self, name, bits, digits, most_exponent):
        self.name, self.bits, self.digits = name, bits, digits
        self.storage = np.dtype(f"f{bits // 8}")
        self.patterns = np.dtype(f"u{bits // 8}")
        # Of the unit in the last place of the least normal number, and of the largest.
        self.least_unit = 3 - most_exponent - digits
        self.most_unit = most_exponent - digits
        self.most = math.ldexp(2**digits - 1, self.most_unit)
        self.normal = math.ldexp(1, self.least_unit + digits - 1)
        self.denormal = math.ldexp(1, self.least_unit)

    def unit(self, value):
        """Exponent of the unit in the last place at an exact value."""
        value = abs(Fraction(value))
        if not value:
            return self.least_unit
        exponent = value.numerator.bit_length() - value.denominator.bit_length()
        if value < Fraction(2)**exponent:
            exponent -= 1
        return min(max(exponent - self.digits + 1, self.least_unit), self.most_unit)

    def rounded(self, value, mode=NEAREST):
        """An exact value (or a special float) rounded to the type. Zero results have the value's sign, +0 for 0."""
        if isinstance(value, float):
            if not math.isfinite(value) or value == 0:
                return value
        negative = value < 0
        value = abs(Fraction(value))
        unit = self.unit(value)
        scaled = value / Fraction(2)**unit
        steps = rounded_to_whole(-scaled if negative else scaled, mode)
        magnitude = abs(steps)
        if magnitude >= 1 << self.digits and unit == self.most_unit:
            to_zero = mode == TO_ZERO or mode == (UP if negative else DOWN)
            magnitude = self.most if to_zero else INFINITY
        else:
            magnitude = math.ldexp(magnitude, unit)
        return -magnitude if negative else magnitude

    def pattern(self, value):
        return int(np.array(value, self.storage).view(self.patterns))

    def of_pattern(self, pattern):
        return float(np.array(pattern, self.patterns).view(self.storage))


def rounded_to_whole(value, mode):
    """An exact value rounded to a whole number."""
    if mode == NEAREST:
        return round(value)
    if mode == UP:
        return math.ceil(value)
    if mode == DOWN:
        return math.floor(value)
    return math.trunc(value)


TYPES = {t.name: t for t in (
    Whole("char", 8, True), Whole("uchar", 8, False), Whole("short", 16, True), Whole("ushort", 16, False),
    Whole("int", 32, True), Whole("uint", 32, False), Whole("long", 64, True), Whole("ulong", 64, False),
    Real("half", 16, 11, 16), Real("float", 32, 24, 128), Real("double", 64, 53, 1024))}
# Addresses have 32 bits.
TYPES.update(size_t=TYPES["uint"], uintptr_t=TYPES["uint"], intptr_t=TYPES["int"], ptrdiff_t=TYPES["int"])
WIDTHS = (1, 2, 3, 4, 8, 16)


class Vector:
    """A type of a value in a kernel: elements of a type, one or more."""

    def __init__(self, name):
        element, width = re.fullmatch(r"(\w*?[a-z_])(\d*)", name).groups()
        self.name, self.element, self.width = name, TYPES[element], int(width or 1)

    @staticmethod
    def known(name):
        match = re.fullmatch(r"(\w*?[a-z_])(\d*)", name)
        return bool(match) and match[1] in TYPES and int(match[2] or 1) in WIDTHS


def whole_of(kind, signed=True):
    """The whole type of the same size."""
    return next(t for t in TYPES.values() if not t.real and t.bits == kind.bits and t.signed == signed)
