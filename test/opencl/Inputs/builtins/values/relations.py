"""Relational functions."""

import math

from .columns import columns, stored
from .formats import Vector, whole_of
from .units import AnyNan, Unit, compared, componentwise, group_of, load, store


def ordered(x, y):
    return not (math.isnan(x) or math.isnan(y))


COMPARISONS = {
    "isequal": lambda t, x, y: x == y,
    "isnotequal": lambda t, x, y: x != y,
    "isgreater": lambda t, x, y: x > y,
    "isgreaterequal": lambda t, x, y: x >= y,
    "isless": lambda t, x, y: x < y,
    "islessequal": lambda t, x, y: x <= y,
    "islessgreater": lambda t, x, y: x < y or x > y,
    "isordered": lambda t, x, y: ordered(x, y),
    "isunordered": lambda t, x, y: not ordered(x, y),
    "isfinite": lambda t, x: math.isfinite(x),
    "isinf": lambda t, x: math.isinf(x),
    "isnan": lambda t, x: math.isnan(x),
    "isnormal": lambda t, x: math.isfinite(x) and abs(x) >= t.normal,
    "signbit": lambda t, x: math.copysign(1, x) < 0,
}


def bitselect(overload, values):
    """Of bits, whatever number they are."""
    kind = values[0].element
    bits = whole_of(kind, False)

    def chosen(a, b, c):
        value = a & ~c | b & c
        # A NaN may become another on its way.
        return AnyNan(kind) if kind.real and math.isnan(kind.of_pattern(value)) else value

    return componentwise(overload, columns([bits] * 3), chosen, bits=bits)


def select(overload, values):
    """Vectors choose by the highest bit, scalars by any."""
    condition = values[2].element
    scalar = values[0].width == 1
    table = columns([v.element for v in values])
    return componentwise(overload, table, lambda a, b, c: b if (c != 0 if scalar else c >> condition.bits - 1 & 1) else a)


def any_or_all(overload, values):
    vector = values[0]
    # Of most vectors no component, or each, has its highest bit set; then one more of them decides.
    rare = (lambda v: v >> 1 & vector.element.most) if overload.name == "any" else (lambda v: -1 - (v >> 1 & vector.element.most))
    column = [v if n // vector.width % 3 == 0 or n % 7 == 0 else rare(v) for n, v in enumerate(columns([vector.element])[0])]
    items = len(column) // vector.width
    text = f"int r = {overload.name}({load(vector, '$I0')}); " + store(Vector("int"), "$O0", "r")

    def check(found):
        rows = [column[n:n + vector.width] for n in range(0, len(column), vector.width)]
        reduce = {"any": any, "all": all}[overload.name]
        return compared(found[0], Vector("int").element, [int(reduce(v < 0 for v in row)) for row in rows], lambda k: rows[k])

    return Unit(overload, items, group_of(items), [stored(column, vector.element)], [4 * items], text, check, [column])


def unit(overload):
    values = overload.values()
    if not values:
        return None
    if overload.name in COMPARISONS:
        kind = values[0].element
        true = -1 if values[0].width > 1 else 1
        return componentwise(overload, columns([v.element for v in values]),
                             lambda *x: true if COMPARISONS[overload.name](kind, *x) else 0)
    makers = {"bitselect": bitselect, "select": select, "any": any_or_all, "all": any_or_all}
    return makers[overload.name](overload, values) if overload.name in makers else None
