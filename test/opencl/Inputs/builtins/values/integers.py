"""Integer functions, and those of common and relational functions that integers have."""

from .columns import columns
from .formats import Vector
from .units import UNDEFINED, componentwise


def mad24(kind, x, y, z=0):
    """Of 24 bits alone; else what it gives is up to the device."""
    low, high = (-2**23, 2**23 - 1) if kind.signed else (0, 2**24 - 1)
    return kind.wrapped(x * y + z) if low <= x <= high and low <= y <= high else UNDEFINED


def rotate(kind, x, y):
    y %= kind.bits
    pattern = kind.pattern(x)
    return kind.of_pattern(pattern << y | pattern >> kind.bits - y)


def trailing_zeros(kind, x):
    return (x & -x).bit_length() - 1 if x else kind.bits


# By the type of the arguments; the results are those of OpenCL C, 6.15.3 "Integer Functions".
FUNCTIONS = {
    "abs": lambda t, x: abs(x),
    "abs_diff": lambda t, x, y: abs(x - y),
    "add_sat": lambda t, x, y: t.clamped(x + y),
    "sub_sat": lambda t, x, y: t.clamped(x - y),
    "hadd": lambda t, x, y: x + y >> 1,
    "rhadd": lambda t, x, y: x + y + 1 >> 1,
    "clamp": lambda t, x, low, high: min(max(x, low), high) if low <= high else UNDEFINED,
    "clz": lambda t, x: t.bits - t.pattern(x).bit_length(),
    "ctz": trailing_zeros,
    "popcount": lambda t, x: t.pattern(x).bit_count(),
    "mad_hi": lambda t, x, y, z: t.wrapped((x * y >> t.bits) + z),
    "mad_sat": lambda t, x, y, z: t.clamped(x * y + z),
    "mul_hi": lambda t, x, y: x * y >> t.bits,
    "max": lambda t, x, y: max(x, y),
    "min": lambda t, x, y: min(x, y),
    "rotate": rotate,
    "mul24": mad24,
    "mad24": mad24,
}


def upsample(result, high, low):
    return result.wrapped(high << result.bits // 2 | low)


def unit(overload):
    values = overload.values()
    if not values or any(v.element.real for v in values):
        return None
    table = columns([v.element for v in values])
    if overload.name == "upsample":
        result = Vector(overload.result).element
        return componentwise(overload, table, lambda high, low: upsample(result, high, low))
    if overload.name not in FUNCTIONS:
        return None
    kind = values[0].element
    if overload.name in ("mul24", "mad24"):
        # Most numbers of 32 bits are too large.
        table = [[v >> 8 if k < 2 and n % 4 else v for n, v in enumerate(column)] for k, column in enumerate(table)]
    return componentwise(overload, table, lambda *x: FUNCTIONS[overload.name](kind, *x))
