"""Functions that read and write memory: vload, vstore, their forms of halves; and shuffles."""

import math
import random
import re

from .columns import ROWS, columns, conversion_column, stored
from .formats import NEAREST, TYPES, Vector, whole_of
from .units import SHARED, UNDEFINED, AnyNan, Unit, compared, group_of, load, store

LOAD = re.compile(r"vload(a)?(_half)?(\d*)")
STORE = re.compile(r"vstore(a)?(_half)?(\d*)(?:_(rt[ezpn]))?")


def scattered(items):
    """Another order of the work-items."""
    order = list(range(items))
    random.Random(items).shuffle(order)
    return order


def copied(space, kind, first, count):
    """(statements that copy some elements of the input into memory of the work-item's own, a pointer to them)"""
    pointer = "mine" if space in ("", "private") else f"((local {kind} *)(shared + {SHARED} * lid))"
    declared = f"{kind} mine[{count}] __attribute__((aligned(128))); " if pointer == "mine" else ""
    return (f"{declared}for (uint k = 0; k < {count}; ++k) {pointer}[k] = ((global const {kind} *)(in + $I0))[{first} + k]; ",
            pointer)


def vload(overload):
    """Loads vector number `order[i]` of an array that begins an element late, where that is allowed."""
    aligned = LOAD.fullmatch(overload.name)[1]
    result = Vector(overload.result)
    pointee, space = overload.kind(1)
    kind = TYPES[pointee]
    width = result.width
    stride = 4 if aligned and width == 3 else width
    first = 0 if aligned else 1
    items = ROWS // 16
    order = scattered(items)
    column = (conversion_column(kind) * 2)[:items * stride + first]
    if space in ("global", "constant"):
        base = "constants + $I0" if space == "constant" else "in + $I0"
        before, pointer = "", f"({space} const {pointee} *)({base} + {first * kind.storage.itemsize})"
        offset = "((global const uint *)(in + $I1))[i]"
    else:
        # The work-item's own memory has its vector and the one before.
        stored_name = "ushort" if pointee == "half" else pointee
        count = 2 * stride + first
        before, pointer = copied(space, stored_name, f"((global const uint *)(in + $I1))[i] * {stride}", count)
        pointer = f"(({space or 'private'} const {pointee} *){pointer} + {first})"
        if space == "":
            pointer = f"({pointee} *){pointer}"
        offset = "lid % 2"
    text = f"{before}{result.name} r = {overload.name}({offset}, {pointer}); " + store(result, "$O0", "r")
    private = space not in ("global", "constant")
    group = group_of(items)
    column += column[:stride + 1]

    def check(found):
        wanted = []
        for i in range(items):
            number = order[i] + (i % group % 2 if private else 0)
            wanted += column[first + number * stride:][:width]
        return compared(found[0], result.element, wanted, lambda k: (f"vector {order[k // width]}", f"element {k % width}"))

    return Unit(overload, items, group, [stored(column, kind), stored(order, TYPES["uint"])],
                [items * width * result.element.storage.itemsize], text, check)


def vstore(overload):
    """Stores as vector number `order[i]` of an array that begins an element late, where that is allowed."""
    aligned, half, _, mode = STORE.fullmatch(overload.name).groups()
    value = Vector(overload.kind(0)[0])
    pointee, space = overload.kind(2)
    kind, width = TYPES[pointee], value.width
    stride = 4 if aligned and width == 3 else width
    first = 0 if aligned else 1
    items = ROWS // 8
    order = scattered(items)
    column = (conversion_column(value.element) * 2)[:items * width]
    size = kind.storage.itemsize
    group = group_of(items)
    plain = "ushort" if pointee == "half" else pointee
    copy = ""
    if space == "global":
        before, pointer = "", f"(global {pointee} *)(out + $O0 + {first * size})"
        offset = "((global const uint *)(in + $I1))[i]"
    else:
        offset = "1"
        local = space == "local"
        pointer = f"((local {plain} *)(shared + {SHARED} * lid))" if local else "mine"
        before = "" if local else f"{plain} mine[{2 * stride + first}] __attribute__((aligned(128))); "
        before += f"for (uint k = 0; k < {2 * stride + first}; ++k) {pointer}[k] = 0; "
        copy = (f"for (uint k = 0; k < {width}; ++k) ((global {plain} *)(out + $O0 + {first * size}))"
                f"[((global const uint *)(in + $I1))[i] * {stride} + k] = {pointer}[{stride + first} + k]; ")
        pointer = f"(({space or 'private'} {pointee} *){pointer} + {first})"
        if space == "":
            pointer = f"({pointee} *){pointer}"
    text = f"{before}{overload.name}({load(value, '$I0')}, {offset}, {pointer}); {copy}"
    bits = whole_of(kind, False)
    untouched = int.from_bytes(b"\xa5" * size, "little")

    def check(found):
        wanted = [untouched] * (items * stride + first)
        shown = {}
        for i, number in enumerate(order):
            # What lies behind an aligned vector of three is part of it.
            for k in range(stride):
                wanted[first + number * stride + k] = UNDEFINED
            for k in range(width):
                argument = column[i * width + k]
                result = kind.rounded(argument, mode or NEAREST) if half else argument
                nan = kind.real and math.isnan(result)
                wanted[first + number * stride + k] = AnyNan(kind) if nan else kind.pattern(result)
                shown[first + number * stride + k] = argument
        return compared(found[0], bits, wanted, lambda k: (f"element {k}", shown.get(k, "untouched")))

    return Unit(overload, items, group, [stored(column, value.element), stored(order, TYPES["uint"])],
                [(items * stride + first) * size], text, check)


def shuffle(overload):
    """The lowest bits of a mask's components choose."""
    values = overload.values()
    *sources, mask = values
    result = Vector(overload.result)
    items = ROWS // 16
    table = columns([v.element for v in values], items * 16)
    table = [column[:items * v.width] for column, v in zip(table, values)]
    arguments = ", ".join(load(v, f"$I{n}") for n, v in enumerate(values))
    text = f"{result.name} r = {overload.name}({arguments}); " + store(result, "$O0", "r")
    width = sources[0].width

    def check(found):
        wanted = []
        for i in range(items):
            pool = [v for column in table[:-1] for v in column[i * width:][:width]]
            wanted += [pool[m % len(pool)] for m in table[-1][i * mask.width:][:mask.width]]
        return compared(found[0], result.element, wanted, lambda k: (f"work-item {k // result.width}",))

    return Unit(overload, items, group_of(items), [stored(c, v.element) for c, v in zip(table, values)],
                [items * result.width * result.element.storage.itemsize], text, check, table)


def unit(overload):
    if LOAD.fullmatch(overload.name):
        return vload(overload)
    if STORE.fullmatch(overload.name):
        return vstore(overload)
    return shuffle(overload) if overload.name in ("shuffle", "shuffle2") else None
