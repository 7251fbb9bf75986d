"""Atomic functions: what they return and leave, of work-items that do not meet.

Each work-item has a place of its own. That many can work on one place is tested elsewhere (LongAtomics_test.cpp,
OpenClC3_test.cpp, Groups_test.cpp).
"""

import re

from .columns import columns, stored
from .formats import TYPES, Vector
from .units import SHARED, Unit, compared, group_of, load, store

ITEMS = 96
NAME = re.compile(r"(?:atom|atomic)_(?:fetch_)?(add|sub|and|or|xor|min|max|inc|dec|xchg|exchange|cmpxchg|init|store|load"
                  r"|compare_exchange_strong|compare_exchange_weak)(?:_explicit)?")
# The new value from the old one and the operand.
NEW = {
    "add": lambda x, y: x + y, "sub": lambda x, y: x - y, "and": lambda x, y: x & y, "or": lambda x, y: x | y,
    "xor": lambda x, y: x ^ y, "min": min, "max": max, "inc": lambda x: x + 1, "dec": lambda x: x - 1,
    "xchg": lambda x, y: y, "exchange": lambda x, y: y, "init": lambda x, y: y, "store": lambda x, y: y, "load": lambda x: x,
}


def element(name):
    """The type of an atomic type's value."""
    return name.removeprefix("atomic_")


def place(space, kind, number):
    """(name of the space, pointer to a place of the work-item's own)"""
    if space == "local":
        return "local", f"((local {kind} *)(shared + {SHARED} * lid) + {number})"
    if space == "private":
        return "private", f"&mine{number}"
    # A generic pointer may point there, too.
    return "global", f"((global {kind} *)(out + $O{1 + number}) + i)"


def orders(overload):
    return "".join(", memory_order_seq_cst" if p == "memory_order" else ", memory_scope_device" for p in overload.parameters
                   if p.startswith("memory_"))


def flag(overload):
    """A flag is set once, and again; or set and cleared."""
    space = overload.kind(0)[1]
    name, pointer = place(space, "int", 0)
    typed = f"(volatile {name} atomic_flag *){pointer}"
    setting = "test_and_set" in overload.name
    call = f"{overload.name}({typed}{orders(overload)})"
    text = f"*{pointer} = i % 2; int r = -1; "
    if setting:
        text += f"r = {call}; r |= {call} << 1; "
    else:
        text += f"{call}; r = atomic_flag_test_and_set({typed}); "
    text += store(Vector("int"), "$O0", "r")
    wanted = [2 + i % 2 if setting else 0 for i in range(ITEMS)]
    return Unit(overload, ITEMS, 48, [], [4 * ITEMS, 4 * ITEMS],
                text, lambda found: compared(found[0], TYPES["int"], wanted, lambda k: (f"set before: {k % 2}",)))


def operation(overload):
    what = NAME.fullmatch(overload.name)[1]
    pointee, space = overload.kind(0)
    exchange = what in ("cmpxchg", "compare_exchange_strong", "compare_exchange_weak")
    through = what.startswith("compare")
    name = element(pointee)
    kind = TYPES[name]
    value = Vector(name)
    count = 1 if what in ("inc", "dec", "load") else 3 if exchange else 2
    # NaNs are left out: they need not keep their bits.
    table = columns([kind] * count, ITEMS * 5)
    rows = [row for row in zip(*table) if all(v == v for v in row)][:ITEMS]
    if len({p for p, _ in overload.kinds()} & {"intptr_t", "uintptr_t"}) and what in ("min", "max"):
        # The header compares them with numbers of the other sign.
        rows = [tuple(v & 0x7fffffff for v in row) for row in rows]
    if exchange:
        rows = [(x, x if k % 2 else e, y) for k, (x, e, y) in enumerate(rows)]
    where, pointer = place(space, name, 0)
    text = "".join(f"{name} a{n} = {load(value, f'$I{n}')}; " for n in range(count)) + f"*{pointer} = a0; "
    typed = f"(volatile {where} {pointee} *){pointer}"
    returns = overload.result != "void"
    after = "" if where == "global" else store(value, "$O1", f"*{pointer}")
    if through:
        expected_space = overload.kind(1)[1] or "private"
        expected_in, expected = place(expected_space, name, 1)
        if expected_in == "private":
            text += f"{name} mine1; "
        text += f"*{expected} = a1; int r = {overload.name}({typed}, {expected}, a2{orders(overload)}); "
        after += "" if expected_in == "global" else store(value, "$O2", f"*({expected})" if expected_in != "private" else "mine1")
    else:
        call = f"{overload.name}({typed}{''.join(f', a{n}' for n in range(1, count))}{orders(overload)})"
        text += f"{name} r = {call}; " if returns else f"{call}; {name} r = a0; "
    result = Vector("int") if through else value
    text += store(result, "$O0", "r") + after
    size = kind.storage.itemsize * ITEMS

    def outcome(row):
        """(result, value left, value left as the expected one)"""
        old = row[0]
        if exchange:
            equal = kind.pattern(old) == kind.pattern(row[1])
            return int(equal) if through else old, row[2] if equal else old, old
        new = NEW[what](*row)
        return old, new if kind.real else kind.wrapped(new), None

    def check(found):
        results = [outcome(row) for row in rows]
        kinds = (result.element, kind, kind)
        return [line for n, output in enumerate(found)
                for line in compared(output, kinds[n], [r[n] for r in results], lambda k: rows[k])]

    return Unit(overload, ITEMS, group_of(ITEMS), [stored(c, kind) for c in zip(*rows)],
                [result.element.storage.itemsize * ITEMS] + [size] * (2 if through else 1), text, check)


def unit(overload):
    if overload.name.startswith("atomic_flag_"):
        return flag(overload)
    return operation(overload) if NAME.fullmatch(overload.name) else None
