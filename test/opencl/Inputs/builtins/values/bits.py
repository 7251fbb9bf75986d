"""Fields of bits and bits in reverse (cl_khr_extended_bit_ops), and dot products of bytes (cl_khr_integer_dot_product)."""

import re

from .columns import columns, stored
from .formats import TYPES, Vector
from .units import Unit, compared, componentwise, group_of, load, store

ITEMS = 240
PACKED = re.compile(r"dot_(acc_sat_)?4x8packed_(uu|ss|us|su)_u?int")


def reverse(kind, x):
    return kind.of_pattern(int(f"{kind.pattern(x):0{kind.bits}b}"[::-1], 2))


def insert(kind, base, field, offset, count):
    mask = (1 << count) - 1 << offset
    return kind.of_pattern(kind.pattern(base) & ~mask | kind.pattern(field) << offset & mask)


def extract(kind, result, value, offset, count):
    field = kind.pattern(value) >> offset & (1 << count) - 1
    negative = result.signed and count and field >> count - 1
    return field - (1 << count) if negative else field


def fields(kind, first, second):
    """Offsets and numbers of bits that are within the type."""
    offsets = [v % (kind.bits + 1) for v in first]
    return [offsets, [v % (kind.bits + 1 - offset) for v, offset in zip(second, offsets)]]


def field_of_bits(overload):
    values = overload.values()
    kind, result = values[0].element, Vector(overload.result).element
    table = columns([v.element for v in values])
    table = table[:-2] + fields(kind, *table[-2:])
    if overload.name == "bitfield_insert":
        return componentwise(overload, table, lambda *x: insert(kind, *x))
    return componentwise(overload, table, lambda *x: extract(kind, result, *x))


def product(result, a, b, total=None):
    """Four products of bytes always fit into the result. With a total, the sum saturates."""
    value = sum(x * y for x, y in zip(a, b))
    return value if total is None else result.clamped(value + total)


def packed(overload, letters):
    kinds = [TYPES["uchar" if letter == "u" else "char"] for letter in letters]
    result = Vector(overload.result).element

    def parts(kind, word):
        return [kind.wrapped(word >> shift) for shift in (0, 8, 16, 24)]

    table = columns([v.element for v in overload.values()])
    return componentwise(overload, table, lambda a, b, *total: product(result, parts(kinds[0], a), parts(kinds[1], b), *total))


def of_vectors(overload):
    values, result = overload.values(), Vector(overload.result)
    table = [columns([v.element] * 2, ITEMS * v.width)[n % 2] for n, v in enumerate(values)]
    arguments = ", ".join(load(v, f"$I{n}") for n, v in enumerate(values))
    text = f"{result.name} r = {overload.name}({arguments}); " + store(result, "$O0", "r")

    def check(found):
        rows = [[column[i * v.width:][:v.width] for column, v in zip(table, values)] for i in range(ITEMS)]
        wanted = [product(result.element, a, b, *(t for total in sums for t in total)) for a, b, *sums in rows]
        return compared(found[0], result.element, wanted, lambda k: [v for a in rows[k] for v in a])

    return Unit(overload, ITEMS, group_of(ITEMS), [stored(c, v.element) for c, v in zip(table, values)],
                [ITEMS * result.element.storage.itemsize], text, check, table)


def unit(overload):
    values = overload.values()
    if not values or any(v.element.real for v in values):
        return None
    if overload.name == "bit_reverse":
        kind = values[0].element
        return componentwise(overload, columns([kind]), lambda x: reverse(kind, x))
    if overload.name.startswith("bitfield_"):
        return field_of_bits(overload)
    match = PACKED.fullmatch(overload.name)
    if match:
        return packed(overload, match[2])
    return of_vectors(overload) if overload.name in ("dot", "dot_acc_sat") else None
