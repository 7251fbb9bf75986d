"""Functions of floating point whose results are exact, or are chosen among their arguments; and common functions."""

import math
from fractions import Fraction

from .columns import columns
from .formats import NAN, Vector
from .units import UNDEFINED, AnyOf, Near, componentwise

LEAST_INT, MOST_INT = -2**31, 2**31 - 1


def numbers(*values):
    return not any(math.isnan(v) for v in values)


def finite(*values):
    return all(math.isfinite(v) for v in values)


def either_zero(value):
    """Which of two zeros is the smaller is free."""
    return AnyOf((0.0, -0.0)) if value == 0 else value


def fmax(t, x, y):
    return y if math.isnan(x) else x if math.isnan(y) else either_zero(max(x, y))


def fmin(t, x, y):
    return y if math.isnan(x) else x if math.isnan(y) else either_zero(min(x, y))


def maxmag(t, x, y):
    return x if abs(x) > abs(y) else y if abs(y) > abs(x) else fmax(t, x, y)


def minmag(t, x, y):
    return x if abs(x) < abs(y) else y if abs(y) < abs(x) else fmin(t, x, y)


def nextafter(t, x, y):
    if not numbers(x, y):
        return NAN
    if x == y:
        return AnyOf((x, y))
    if x == 0:
        return math.copysign(t.denormal, y)
    away = (y > x) == (x > 0)
    return t.of_pattern(t.pattern(x) + (1 if away else -1))


def fract(t, x):
    if not finite(x):
        return (x if math.isnan(x) else math.copysign(0.0, x)), x
    floor = Fraction(math.floor(x))
    part = min(t.rounded(Fraction(x) - floor), 1 - 2.0**-t.digits)
    whole = t.rounded(floor)
    return (math.copysign(part, x) if x == 0 else part), math.copysign(whole, x) if whole == 0 else whole


def modf(t, x):
    if not finite(x):
        return (x if math.isnan(x) else math.copysign(0.0, x)), x
    part, whole = math.modf(x)
    return part, whole


def frexp(t, x):
    return math.frexp(x) if finite(x) else (x, 0)


def ilogb(t, x):
    if x == 0:
        return AnyOf((LEAST_INT, -MOST_INT))
    if math.isnan(x):
        return AnyOf((LEAST_INT, MOST_INT))
    return MOST_INT if math.isinf(x) else math.frexp(x)[1] - 1


def ldexp(t, x, n):
    if not finite(x) or x == 0:
        return x
    n = min(max(n, -5000), 5000)
    return math.copysign(t.rounded(Fraction(x) * Fraction(2)**n), x)


def product_and_sum(t, x, y, z):
    """Rounded once or twice."""
    if not finite(x, y):
        return x * y + z
    if not math.isfinite(z):
        # A product that overflows is an infinity of its own, if it is rounded.
        return AnyOf((z, z + t.rounded(Fraction(x) * Fraction(y))))
    exact = Fraction(x) * Fraction(y)
    product = t.rounded(exact)
    once = exact + Fraction(z)
    zero = x * y + z if not once else None
    fused = t.rounded(once) if once else either_zero(zero)
    if not finite(product):
        return AnyOf((fused, product))
    twice = Fraction(product) + Fraction(z)
    return AnyOf((fused, t.rounded(twice) if twice else either_zero(0.0)))


def remquo(t, x, y):
    if not numbers(x, y) or math.isinf(x) or y == 0:
        return NAN, 0
    if math.isinf(y):
        return x, 0
    quotient = Fraction(x) / Fraction(y)
    whole = round(quotient)
    rest = t.rounded(Fraction(x) - whole * Fraction(y))
    bits = abs(whole) & 127
    signed = -bits if quotient < 0 else bits
    # "The lower seven bits": more may be there.
    return (math.copysign(rest, x) if rest == 0 else rest), SevenBits(signed)


class SevenBits:
    """A quotient's sign and lowest bits."""

    def __init__(self, value):
        self.value = value

    def accepts(self, got):
        return abs(got) & 127 == abs(self.value) and (got == 0 or (got < 0) == (self.value < 0) or self.value == 0)

    def __repr__(self):
        return f"{self.value} in the lowest 7 bits"


def common_max(t, x, y):
    return either_zero(y if x < y else x) if numbers(x, y) else UNDEFINED


def common_min(t, x, y):
    return either_zero(y if y < x else x) if numbers(x, y) else UNDEFINED


def clamp(t, x, low, high):
    return either_zero(min(max(x, low), high)) if numbers(x, low, high) and low <= high else UNDEFINED


def mix(t, x, y, a):
    """x + (y - x) * a, each step rounded, or two at once."""
    if not finite(x, y, a):
        return UNDEFINED
    x, y, a = map(Fraction, (x, y, a))
    sizes = (abs(x), abs(y), abs((y - x) * a), abs(y - x))
    if max(sizes) > Fraction(t.most) / 4:
        return UNDEFINED
    largest = max(abs(x), abs((y - x) * a))
    return Near(x + (y - x) * a, 3 * Fraction(2)**t.unit(largest))


def smoothstep(t, low, high, x):
    if not finite(low, high, x) or low >= high:
        return UNDEFINED
    low, high, x = map(Fraction, (low, high, x))
    if high - low > t.most or abs(x - low) > t.most:
        return UNDEFINED
    part = min(max((x - low) / (high - low), 0), 1)
    tolerance = 1e-5 if t.name == "float" else 16 * 2.0**-t.digits
    return Near(part * part * (3 - 2 * part), tolerance)


def sign(t, x):
    return 0.0 if math.isnan(x) else x if x == 0 else math.copysign(1.0, x)


def step(t, edge, x):
    return (0.0 if x < edge else 1.0) if numbers(edge, x) else UNDEFINED


FUNCTIONS = {
    "copysign": lambda t, x, y: math.copysign(x, y), "fmax": fmax, "fmin": fmin, "maxmag": maxmag, "minmag": minmag,
    "nextafter": nextafter, "fract": fract, "modf": modf, "frexp": frexp, "ilogb": ilogb, "ldexp": ldexp,
    "mad": product_and_sum, "nan": lambda t, code: NAN, "remquo": remquo, "max": common_max, "min": common_min,
    "clamp": clamp, "mix": mix, "smoothstep": smoothstep, "sign": sign, "step": step,
}


def unit(overload):
    if overload.name not in FUNCTIONS:
        return None
    result = Vector(overload.result).element
    kinds = [Vector(name).element for name, space in overload.kinds() if space is None]
    real = next((k for k in kinds if k.real), result)
    if not real.real:
        return None
    table = columns(kinds)
    if overload.name == "clamp":
        # Mostly with a range that is one.
        table[1:] = zip(*((min(r), max(r)) if n % 8 else r for n, r in enumerate(zip(*table[1:]))))
    return componentwise(overload, table, lambda *x: FUNCTIONS[overload.name](real, *x))
