"""Copies by a whole group, and functions that only order what is around them."""

from .columns import columns, stored
from .formats import TYPES, Vector
from .units import UNDEFINED, Unit, compared, load, store

ITEMS, GROUP = 96, 48
GROUPS = ITEMS // GROUP
# Elements that each group copies, and from how many of which one is taken with a stride.
COUNT, STRIDE = 13, 3


def copy(overload):
    """Between global and local memory, a share of the input for each group."""
    strided = "strided" in overload.name
    (pointee, to), (_, source) = overload.kinds()[:2]
    vector = Vector(pointee)
    kind, width = vector.element, vector.width
    # In memory a vector of three takes the place of four.
    place = 4 if width == 3 else width
    # One side of a strided copy is dense: the local one.
    spread = STRIDE if strided else 1
    elements = COUNT * spread
    column = columns([kind], GROUPS * elements * place)[0]
    stride = f", {STRIDE}" if strided else ""
    first = f"{elements} * get_group_id(0)"
    text = f"local {pointee} *mine = (local {pointee} *)shared; barrier(CLK_LOCAL_MEM_FENCE); "
    given = f"((global const {pointee} *)(in + $I0) + {first})"
    taken = f"((global {pointee} *)(out + $O0) + {first})"
    if to == "local":
        text += (f"event_t e = {overload.name}(mine, {given}, {COUNT}{stride}, 0); wait_group_events(1, &e); "
                 f"if (lid < {COUNT}) {taken}[lid * {spread}] = mine[lid]; ")
    else:
        text += (f"if (lid < {COUNT}) mine[lid] = {given}[lid * {spread}]; barrier(CLK_LOCAL_MEM_FENCE); "
                 f"event_t e = {overload.name}({taken}, mine, {COUNT}{stride}, 0); wait_group_events(1, &e); ")
    text += "barrier(CLK_LOCAL_MEM_FENCE); "
    bits = TYPES["u" + {1: "char", 2: "short", 4: "int", 8: "long"}[kind.storage.itemsize]]
    untouched = int.from_bytes(b"\xa5" * kind.storage.itemsize, "little")

    def check(found):
        wanted = []
        for number in range(GROUPS * elements):
            here = column[number * place:][:width]
            wanted += [kind.pattern(v) if v == v else UNDEFINED for v in here] if number % spread == 0 else [untouched] * width
            wanted += [UNDEFINED] * (place - width)
        return compared(found[0], bits, wanted, lambda k: (f"element {k // place}",))

    return Unit(overload, ITEMS, GROUP, [stored(column, kind)], [GROUPS * elements * place * kind.storage.itemsize], text, check)


def prefetch(overload):
    """It has no effect."""
    vector = Vector(overload.kind(0)[0])
    column = columns([vector.element], ITEMS * (4 if vector.width == 3 else vector.width))[0]
    text = (f"prefetch((global const {vector.name} *)(in + $I0) + i, 1); " + store(Vector("uint"), "$O0", "i"))
    return Unit(overload, ITEMS, GROUP, [stored(column, vector.element)], [4 * ITEMS], text,
                lambda found: compared(found[0], TYPES["uint"], range(ITEMS), lambda k: (k,)))


# What they are called with, and the work-items among which values can then be read.
LOCAL = "CLK_LOCAL_MEM_FENCE"
MEETING = {"barrier": GROUP, "work_group_barrier": GROUP, "sub_group_barrier": 16, "mem_fence": 1, "read_mem_fence": 1,
           "write_mem_fence": 1, "atomic_work_item_fence": 1}


def meeting(overload):
    """After a barrier each work-item reads what another of the part wrote; after a fence what it wrote itself."""
    size = MEETING[overload.name]
    arguments = ", ".join({"memory_order": "memory_order_acq_rel", "memory_scope": "memory_scope_work_group"}.get(p, LOCAL)
                          for p in overload.parameters)
    column = columns([TYPES["uint"]], ITEMS)[0]
    other = f"(lid / {size} * {size} + {size - 1} - lid % {size})"
    text = (f"local uint *mine = (local uint *)shared; barrier({LOCAL}); mine[lid] = {load(Vector('uint'), '$I0')}; "
            f"{overload.name}({arguments}); " + store(Vector("uint"), "$O0", f"mine[{other}]") + f"barrier({LOCAL}); ")

    def check(found):
        wanted = [column[i // size * size + size - 1 - i % size] for i in range(ITEMS)]
        return compared(found[0], TYPES["uint"], wanted, lambda k: (f"work-item {k}",))

    return Unit(overload, ITEMS, GROUP, [stored(column, TYPES["uint"])], [4 * ITEMS], text, check)


def unit(overload):
    if overload.name.startswith("async_work_group_"):
        return copy(overload)
    if overload.name == "prefetch":
        return prefetch(overload)
    return meeting(overload) if overload.name in MEETING else None
