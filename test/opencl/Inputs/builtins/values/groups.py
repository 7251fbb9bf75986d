"""Functions of groups and subgroups, and questions about work-items.

Each launch has groups of GROUP work-items in one dimension: subgroups of 16, of which the last is smaller.
"""

import random
import re

from .columns import columns, drawn, specials, stored
from .formats import TYPES, Vector
from .units import UNDEFINED, AnyOf, Unit, compared, load, store

ITEMS, GROUP, SUBGROUP = 120, 40, 16
# In each subgroup there is such a work-item, and it is one of the ACTIVE.
CHOSEN = 6
CLUSTER = 4


def least(kind):
    return -float("inf") if kind.real else kind.least


def most(kind):
    return float("inf") if kind.real else kind.most


# (what two values give, what changes no value)
OPERATIONS = {
    "add": (lambda x, y: x + y, lambda t: 0), "mul": (lambda x, y: x * y, lambda t: 1), "min": (min, most), "max": (max, least),
    "and": (lambda x, y: x & y, lambda t: -1), "or": (lambda x, y: x | y, lambda t: 0), "xor": (lambda x, y: x ^ y, lambda t: 0),
    "logical_and": (lambda x, y: int(bool(x) and bool(y)), lambda t: 1),
    "logical_or": (lambda x, y: int(bool(x) or bool(y)), lambda t: 0),
    "logical_xor": (lambda x, y: int(bool(x) != bool(y)), lambda t: 0),
}
NAME = re.compile(r"(work_group|sub_group)_(non_uniform_|clustered_)?(reduce|scan_inclusive|scan_exclusive)_(\w+)")


def reduced(operation, kind, values):
    combine, neutral = OPERATIONS[operation]
    result = neutral(kind)
    for value in values:
        result = combine(result, value)
    return float(result) if kind.real else kind.wrapped(result)


def zero_free(kind, value):
    """The sign of a zero depends on the order of additions, which is free."""
    return AnyOf((0.0, -0.0)) if kind.real and value == 0 else value


def values_for(operation, kind):
    """Sums and products of floats must not depend on the order."""
    source = random.Random(operation + kind.name)
    if operation and operation.startswith("logical"):
        return [source.choice((0, 0, 1, -1, 4)) if n // GROUP else 1 for n in range(ITEMS)]
    if not kind.real:
        return [source.choice(specials(kind)) if n % 3 else drawn(kind, source) for n in range(ITEMS)]
    if operation == "add":
        return [float(source.randint(-8, 8)) for _ in range(ITEMS)]
    if operation == "mul":
        return [source.choice((1.0, -1.0, 1.0, 2.0, 0.5) if n % 4 else (1.0,)) for n in range(ITEMS)]
    return [v for v in columns([kind])[0] if v == v][:ITEMS]


def parts(size, active=lambda lid: True):
    """Work-items of each part of each group, parts of so many work-items; those that take part."""
    for group in range(0, ITEMS, GROUP):
        for first in range(0, GROUP, size):
            yield [group + lid for lid in range(first, min(first + size, GROUP)) if active(lid)]


def launched(overload, call, result, wanted, inputs=(), active=None, described=None):
    """A unit of a call by all work-items, or by those for which the text `active` holds."""
    kind = result.element
    before = f"{result.name} r; for (uint k = 0; k < sizeof(r); ++k) ((char *)&r)[k] = 0; "
    text = before + (f"if ({active}) " if active else "") + f"r = {call}; " + store(result, "$O0", "r")
    return Unit(overload, ITEMS, GROUP, list(inputs), [ITEMS * result.width * kind.storage.itemsize], text,
                lambda found: compared(found[0], kind, wanted(), described or (lambda k: (f"work-item {k // result.width}",))))


# Of non-uniform functions some work-items take part.
ACTIVE, IS_ACTIVE = "lid % 4 != 1", (lambda lid: lid % 4 != 1)


def collective(overload):
    """Reductions and scans."""
    group, form, shape, operation = NAME.fullmatch(overload.name).groups()
    values, result = overload.values(), Vector(overload.result)
    kind = result.element
    column = values_for(operation, kind)
    some = form == "non_uniform_"
    size = GROUP if group == "work_group" else CLUSTER if form == "clustered_" else SUBGROUP

    def wanted():
        found = [UNDEFINED] * ITEMS
        for part in parts(size, IS_ACTIVE if some else lambda lid: True):
            for n, item in enumerate(part):
                taken = part if shape == "reduce" else part[:n + 1] if shape == "scan_inclusive" else part[:n]
                found[item] = zero_free(kind, reduced(operation, kind, [column[k] for k in taken]))
        return found

    call = f"{overload.name}({load(values[0], '$I0')}{f', {CLUSTER}' if form == 'clustered_' else ''})"
    return launched(overload, call, result, wanted, [stored(column, kind)], ACTIVE if some else None)


def broadcast(overload):
    """The value of a work-item that all choose."""
    values, result = overload.values(), Vector(overload.result)
    kind, width = result.element, result.width
    column = columns([kind], ITEMS * width)[0]
    some, first = "non_uniform" in overload.name, "first" in overload.name
    size = GROUP if overload.name.startswith("work_group") else SUBGROUP
    chosen = 37 if size == GROUP else CHOSEN

    def wanted():
        found = [UNDEFINED] * ITEMS * width
        for part in parts(size, IS_ACTIVE if some or first else lambda lid: True):
            source = part[0] if first else part[0] // GROUP * GROUP + (part[0] % GROUP) // size * size + chosen
            for item in part:
                for c in range(width):
                    found[item * width + c] = column[source * width + c]
        return found

    ids = "" if first else f", {chosen}" + ", 0" * (len(values) - 2)
    call = f"{overload.name}({load(values[0], '$I0')}{ids})"
    return launched(overload, call, result, wanted, [stored(column, kind)], ACTIVE if some or first else None)


# The work-item of a subgroup from which another takes its value, from its number and the operand.
EXCHANGES = {
    "sub_group_shuffle": lambda n, d: d, "sub_group_shuffle_xor": lambda n, d: n ^ d,
    "sub_group_shuffle_up": lambda n, d: n - d, "sub_group_shuffle_down": lambda n, d: n + d,
    "sub_group_rotate": lambda n, d: (n + d) % SUBGROUP,
    "sub_group_clustered_rotate": lambda n, d: n // CLUSTER * CLUSTER + (n + d) % CLUSTER,
}


def exchange(overload):
    values, result = overload.values(), Vector(overload.result)
    kind = result.element
    column = columns([kind], ITEMS)[0]
    uniform = "rotate" in overload.name
    source = random.Random(overload.name)
    operands = [3 if uniform else source.randrange(SUBGROUP) for _ in range(ITEMS)]

    def wanted():
        found = [UNDEFINED] * ITEMS
        for part in parts(SUBGROUP):
            for n, item in enumerate(part):
                other = EXCHANGES[overload.name](n, operands[item])
                found[item] = column[part[other]] if 0 <= other < len(part) else UNDEFINED
        return found

    operand = "3" if uniform else load(values[1], "$I1")
    call = f"{overload.name}({load(values[0], '$I0')}, {operand}{f', {CLUSTER}' if 'clustered' in overload.name else ''})"
    return launched(overload, call, result, wanted, [stored(column, kind), stored(operands, TYPES["uint"])])


def vote(overload):
    """Questions to all: of the first group all say yes, of the last none."""
    name = overload.name
    some = "non_uniform" in name
    source = random.Random(name)
    size = GROUP if name.startswith("work_group") else SUBGROUP
    value = overload.values()[0]
    kind = value.element
    equal = name.endswith("all_equal")
    base = [1, 1, 0] if not kind.real else [1.0, 1.5, 0.5]
    column = [base[0] if n < GROUP else base[2] if n >= 2 * GROUP else source.choice(base) for n in range(ITEMS)]
    if equal:
        # One of each other subgroup differs; in some it takes no part.
        column = [base[2] if n % 32 == (16 if n < 60 else 17) else base[0] for n in range(ITEMS)]

    def wanted():
        found = [UNDEFINED] * ITEMS
        for part in parts(size, IS_ACTIVE if some else lambda lid: True):
            those = [column[k] for k in part]
            answer = len(set(those)) == 1 if equal else all(those) if name.endswith("all") else any(those)
            for item in part:
                found[item] = int(answer)
        return found

    return launched(overload, f"{name}({load(value, '$I0')})", Vector("int"), wanted, [stored(column, kind)],
                    ACTIVE if some else None)


def mask_words(bits):
    return [bits & 0xffffffff, 0, 0, 0]


def all_bits(number):
    return (1 << number) - 1


# Masks by the work-item's number in its subgroup. Bits stand for the work-items of the largest subgroup.
MASKS = {"eq": lambda n: 1 << n, "ge": lambda n: all_bits(SUBGROUP) & ~all_bits(n),
         "gt": lambda n: all_bits(SUBGROUP) & ~all_bits(n + 1), "le": lambda n: all_bits(n + 1), "lt": all_bits}
# Of a ballot and the work-item's number.
BALLOTS = {
    "sub_group_ballot_bit_count": lambda b, n, size: (b & all_bits(size)).bit_count(),
    "sub_group_ballot_inclusive_scan": lambda b, n, size: (b & all_bits(n + 1)).bit_count(),
    "sub_group_ballot_exclusive_scan": lambda b, n, size: (b & all_bits(n)).bit_count(),
    "sub_group_ballot_find_lsb": lambda b, n, size: (b & -b).bit_length() - 1 if b & all_bits(size) else UNDEFINED,
    "sub_group_ballot_find_msb": lambda b, n, size: (b & all_bits(size)).bit_length() - 1 if b & all_bits(size) else UNDEFINED,
    "sub_group_inverse_ballot": lambda b, n, size: b >> n & 1,
    "sub_group_ballot_bit_extract": lambda b, n, size: b >> n & 1,
}


def ballot(overload):
    name = overload.name
    source = random.Random(name)
    if name == "sub_group_ballot":
        column = [source.randrange(2) for _ in range(ITEMS)]

        def wanted():
            found = [UNDEFINED] * 4 * ITEMS
            for part in parts(SUBGROUP, IS_ACTIVE):
                first = part[0] // GROUP * GROUP + (part[0] % GROUP) // SUBGROUP * SUBGROUP
                bits = sum(1 << k - first for k in part if column[k])
                for item in part:
                    for c, word in enumerate(mask_words(bits)):
                        found[4 * item + c] = word
            return found

        return launched(overload, f"{name}({load(Vector('int'), '$I0')})", Vector("uint4"), wanted,
                        [stored(column, TYPES["int"])], ACTIVE)
    # A mask that all of a subgroup agree on.
    masks = [source.getrandbits(SUBGROUP) & (0xff if (n % GROUP) // SUBGROUP == 2 else 0xffff) or 4 for n in range(ITEMS)]
    masks = [masks[n - (n % GROUP) % SUBGROUP] for n in range(ITEMS)]
    column = [word for m in masks for word in mask_words(m)]

    def answers():
        found = [UNDEFINED] * ITEMS
        for part in parts(SUBGROUP):
            for n, item in enumerate(part):
                found[item] = BALLOTS[name](masks[item], n, len(part))
        return found

    result = Vector(overload.result)
    index = ", get_sub_group_local_id()" if len(overload.parameters) == 2 else ""
    return launched(overload, f"{name}({load(Vector('uint4'), '$I0')}{index})", result, answers, [stored(column, TYPES["uint"])])


def elect(overload):
    def wanted():
        found = [UNDEFINED] * ITEMS
        for part in parts(SUBGROUP, IS_ACTIVE):
            for n, item in enumerate(part):
                found[item] = int(n == 0)
        return found

    return launched(overload, "sub_group_elect()", Vector("int"), wanted, active=ACTIVE)


def subgroup_size(item):
    return min(SUBGROUP, GROUP - item % GROUP // SUBGROUP * SUBGROUP)


# From the work-item's number. Those with a parameter are asked of four dimensions, and give the results of them.
QUESTIONS = {
    "get_work_dim": lambda i: 1,
    "get_global_size": lambda i: (ITEMS, 1, 1, 1), "get_global_id": lambda i: (i, 0, 0, 0),
    "get_global_offset": lambda i: (0, 0, 0, 0), "get_global_linear_id": lambda i: i,
    "get_local_size": lambda i: (GROUP, 1, 1, 1), "get_enqueued_local_size": lambda i: (GROUP, 1, 1, 1),
    "get_local_id": lambda i: (i % GROUP, 0, 0, 0), "get_local_linear_id": lambda i: i % GROUP,
    "get_num_groups": lambda i: (ITEMS // GROUP, 1, 1, 1), "get_group_id": lambda i: (i // GROUP, 0, 0, 0),
    "get_max_sub_group_size": lambda i: SUBGROUP, "get_sub_group_size": subgroup_size,
    "get_num_sub_groups": lambda i: -(-GROUP // SUBGROUP), "get_enqueued_num_sub_groups": lambda i: -(-GROUP // SUBGROUP),
    "get_sub_group_id": lambda i: i % GROUP // SUBGROUP, "get_sub_group_local_id": lambda i: i % GROUP % SUBGROUP,
}


def question(overload):
    answers = [QUESTIONS[overload.name](i) for i in range(ITEMS)]
    if not overload.parameters:
        return launched(overload, f"{overload.name}()", Vector("uint"), lambda: answers)
    call = f"(uint4)({', '.join(f'{overload.name}({d})' for d in range(4))})"
    return launched(overload, call, Vector("uint4"), lambda: [v for each in answers for v in each])


def unit(overload):
    name = overload.name
    if name in QUESTIONS:
        return question(overload)
    if NAME.fullmatch(name):
        return collective(overload)
    if name in EXCHANGES:
        return exchange(overload)
    if re.fullmatch(r"(work|sub)_group_(non_uniform_)?(all|any|all_equal)", name):
        return vote(overload)
    if re.fullmatch(r"(work|sub)_group_(non_uniform_)?broadcast(_first)?", name):
        return broadcast(overload)
    if name == "sub_group_ballot" or name in BALLOTS:
        return ballot(overload)
    mask = re.fullmatch(r"get_sub_group_(\w\w)_mask", name)
    if mask:
        words = [w for i in range(ITEMS) for w in mask_words(MASKS[mask[1]](i % GROUP % SUBGROUP))]
        return launched(overload, f"{name}()", Vector("uint4"), lambda: words)
    return elect(overload) if name == "sub_group_elect" else None
