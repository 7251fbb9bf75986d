"""Geometric functions."""

import math
from fractions import Fraction

from .columns import columns, stored
from .formats import NAN, Vector
from .units import UNDEFINED, AnyOf, Near, Unit, compared, group_of, load, store

ITEMS = 240


def root(value):
    """Of an exact value, to 200 bits and more."""
    if not value:
        return Fraction(0)
    shift = max(0, 400 - value.numerator.bit_length() + value.denominator.bit_length())
    shift += shift % 2
    return Fraction(math.isqrt((value.numerator << shift) // value.denominator), 1 << shift // 2)


def within(t, exact, ulps):
    """A result with an error in units of the last place; beyond the largest number, infinity."""
    tolerance = Fraction(ulps) * Fraction(2)**t.unit(exact)
    near = Near(exact, tolerance)
    if abs(exact) + tolerance > t.most:
        return AnyOf((near, math.copysign(math.inf, exact)))
    return near


def exact_all(vector):
    return [Fraction(v) for v in vector]


def finite(*vectors):
    return all(math.isfinite(v) for vector in vectors for v in vector)


def epsilon(t):
    return Fraction(2)**(1 - t.digits)


def dot(t, p, q):
    if not finite(p, q):
        return [UNDEFINED]
    products = [a * b for a, b in zip(exact_all(p), exact_all(q))]
    if sum(map(abs, products)) > Fraction(t.most) / 2:
        return [UNDEFINED]
    most = max(map(abs, exact_all(p) + exact_all(q)))
    return [Near(sum(products), most * most * (2 * len(p) - 1) * epsilon(t) + len(p) * Fraction(t.denormal))]


def cross(t, p, q):
    if not finite(p, q):
        return [UNDEFINED] * len(p)
    a, b = exact_all(p), exact_all(q)
    most = max(map(abs, a[:3] + b[:3]))
    if most * most * 2 > t.most:
        return [UNDEFINED] * len(p)
    tolerance = most * most * 3 * epsilon(t) + 3 * Fraction(t.denormal)
    parts = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    return [Near(v, tolerance) for v in parts] + [0.0] * (len(p) - 3)


def length_with(t, v, ulps):
    if any(math.isnan(x) for x in v):
        return UNDEFINED if any(math.isinf(x) for x in v) else NAN
    if not finite(v):
        return math.inf
    return within(t, root(sum(x * x for x in exact_all(v))), ulps)


def length(t, v):
    n = len(v)
    return [length_with(t, v, {"half": 0.25 + 0.5 * n, "float": 2.75 + 0.5 * n, "double": 5.5 + n}[t.name])]


def distance(t, p, q):
    n = len(p)
    if not finite(p, q):
        return [UNDEFINED]
    difference = [a - b for a, b in zip(exact_all(p), exact_all(q))]
    if any(abs(d) > t.most for d in difference):
        return [UNDEFINED]
    return [length_with(t, difference, {"half": 2 * n, "float": 2.5 + 2 * n, "double": 5.5 + 2 * n}[t.name])]


def normalized(t, v, ulps):
    if any(math.isnan(x) for x in v):
        return [NAN] * len(v)
    if not finite(v):
        v = [math.copysign(1.0, x) if math.isinf(x) else math.copysign(0.0, x) for x in v]
    if not any(v):
        return list(v)
    of = root(sum(x * x for x in exact_all(v)))
    return [within(t, x / of, ulps) if x else AnyOf((0.0, -0.0)) for x in exact_all(v)]


def normalize(t, v):
    n = len(v)
    return normalized(t, v, {"half": 1 + n, "float": 2 + n, "double": 4.5 + n}[t.name])


def ordinary(t, v):
    """Whether squares of the vector do without the ends of the range."""
    return finite(v) and t.normal * 2**t.digits < sum(x * x for x in exact_all(v)) < t.most


def fast_length(t, v):
    return [length_with(t, v, 8191.5 + len(v)) if ordinary(t, v) else UNDEFINED]


def fast_distance(t, p, q):
    if not finite(p, q):
        return [UNDEFINED]
    difference = [a - b for a, b in zip(exact_all(p), exact_all(q))]
    return [length_with(t, difference, 8191.5 + 2 * len(p)) if ordinary(t, difference) else UNDEFINED]


def fast_normalize(t, v):
    return normalized(t, v, 8192 + len(v)) if ordinary(t, v) else [UNDEFINED] * len(v)


FUNCTIONS = {"dot": dot, "cross": cross, "length": length, "distance": distance, "normalize": normalize,
             "fast_length": fast_length, "fast_distance": fast_distance, "fast_normalize": fast_normalize}


def unit(overload):
    if overload.name not in FUNCTIONS:
        return None
    values, result = overload.values(), Vector(overload.result)
    vector = values[0]
    table = columns([vector.element] * len(values), ITEMS * vector.width)
    arguments = ", ".join(load(v, f"$I{n}") for n, v in enumerate(values))
    text = f"{result.name} r = {overload.name}({arguments}); " + store(result, "$O0", "r")

    def check(found):
        rows = [[column[i * vector.width:][:vector.width] for column in table] for i in range(ITEMS)]
        wanted = [w for row in rows for w in FUNCTIONS[overload.name](vector.element, *row)]
        return compared(found[0], result.element, wanted, lambda k: [v for a in rows[k // result.width] for v in a])

    return Unit(overload, ITEMS, group_of(ITEMS), [stored(c, vector.element) for c in table],
                [ITEMS * result.width * result.element.storage.itemsize], text, check, table)
