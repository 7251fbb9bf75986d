"""Local variables and vectors in LLVM's code, for ir_functions.py: what a lane keeps in memory, and what its index selects."""

import dataclasses

from ir_operations import COMPARISONS, FLOAT, PLAIN

SIZE = 16          # bytes of a variable
VECTOR_LENGTHS = [2, 3, 4, 8]


@dataclasses.dataclass(frozen=True)
class Variable:
    """Bytes in memory, each lane's own."""
    name: str
    lanes: list


def new_variable(function):
    """Of which every byte is written at once."""
    variable = Variable(f"%m{len(function.allocations)}", [bytearray(SIZE) for _ in function.pool[0].values])
    function.allocations.append(f"  {variable.name} = alloca [{SIZE} x i8], align 16")
    function.variables.append(variable)
    for at in range(0, SIZE, 8):
        store(function, [variable] * len(variable.lanes), variable.name, 64, (str(at), [at] * len(variable.lanes), 16 if at == 0 else at & -at))
    return variable


def place(function):
    """Of a variable, or of one of two that each lane chooses: the variable of each lane, and a name."""
    rng = function.rng
    if not function.variables or rng.random() < 0.3:
        new_variable(function)
    first, second = rng.choice(function.variables), rng.choice(function.variables)
    if first is second or rng.random() < 0.7:
        return [first] * len(first.lanes), first.name
    condition, name = function.of_kind(1, constants=False), function.name()
    function.lines.append(f"  {name} = select i1 {condition.name}, ptr {first.name}, ptr {second.name}")
    return [first if take else second for take in condition.values], name


def offset(function, size):
    """Where a value of that many bytes lies: its text, each lane's bytes, and an alignment that it has."""
    rng, lanes = function.rng, len(function.pool[0].values)
    if rng.random() < 0.5:
        at = rng.randrange(SIZE - size + 1)
        return str(at), [at] * lanes, at & -at or 16
    value = function.of_kind(32, constants=False)
    step = rng.choice([1, 2, 4])
    mask = 7 & -step
    masked = function.add(32, f"and i32 {value.name}, {mask}", [number & mask for number in value.values])
    return masked.name, masked.values, step


def address(function, name, where):
    """A pointer, and the alignment as an access says it, which may be lower than it is."""
    text, _, alignment = where
    pointer = function.name()
    function.lines.append(f"  {pointer} = getelementptr inbounds i8, ptr {name}, i32 {text}")
    return pointer, min(alignment, function.rng.choice([1, 2, 4, 8]))


def volatile(function):
    return "volatile " if function.rng.random() < 0.1 else ""


def store(function, variables, name, kind, where):
    value = function.of_kind(kind)
    pointer, alignment = address(function, name, where)
    function.lines.append(f"  store {volatile(function)}i{kind} {value.name}, ptr {pointer}, align {alignment}")
    for lane, (variable, number, at) in enumerate(zip(variables, value.values, where[1])):
        variable.lanes[lane][at:at + kind // 8] = number.to_bytes(kind // 8, "little")


def through_memory(function, kind):
    """Some stores, and a load of those bytes or of others."""
    if kind == FLOAT or kind % 8:
        return
    for _ in range(function.rng.randint(0, 2)):
        width = function.rng.choice([8, 16, 24, 32, 32, 40, 64])
        variables, name = place(function)
        store(function, variables, name, width, offset(function, width // 8))
    variables, name = place(function)
    where = offset(function, kind // 8)
    pointer, alignment = address(function, name, where)
    function.add(kind, f"load {volatile(function)}i{kind}, ptr {pointer}, align {alignment}",
                 [int.from_bytes(variable.lanes[lane][at:at + kind // 8], "little")
                  for lane, (variable, at) in enumerate(zip(variables, where[1]))])


def vector_of(function, kind, length):
    """Its name and each lane's elements: values of the pool, one after the other, at places that a lane may choose."""
    lanes = len(function.pool[0].values)
    name, elements = "zeroinitializer", [[0] * length for _ in range(lanes)]
    for element in range(length):
        value = function.of_kind(kind)
        text, places = str(element), [element] * lanes
        if function.rng.random() < 0.2:
            text, places = index(function, length)
        before, name = name, function.name()
        function.lines.append(f"  {name} = insertelement <{length} x i{kind}> {before}, i{kind} {value.name}, i32 {text}")
        for lane, at in enumerate(places):
            elements[lane][at] = value.values[lane]
    return name, elements


def index(function, length):
    """One that each lane has itself, below the length."""
    value = function.of_kind(32, constants=False)
    below = function.add(32, f"urem i32 {value.name}, {length}", [number % length for number in value.values])
    return below.name, below.values


def vector_operation(function, kind, length, first, second):
    """Element by element, or a shuffle of both."""
    rng, name = function.rng, function.name()
    kind_text = f"<{length} x i{kind}>"
    choice = rng.random()
    if choice < 0.4:
        mask = [rng.randrange(2 * length) for _ in range(length)]
        function.lines.append(f"  {name} = shufflevector {kind_text} {first[0]}, {kind_text} {second[0]}, "
                              f"<{length} x i32> <{', '.join(f'i32 {at}' for at in mask)}>")
        return name, [[(a + b)[at] for at in mask] for a, b in zip(first[1], second[1])]
    if choice < 0.6:
        predicate, flags = rng.choice(list(COMPARISONS)), function.name()
        function.lines.append(f"  {flags} = icmp {predicate} {kind_text} {first[0]}, {second[0]}")
        function.lines.append(f"  {name} = select <{length} x i1> {flags}, {kind_text} {first[0]}, {kind_text} {second[0]}")
        return name, [[x if COMPARISONS[predicate](x, y, kind) else y for x, y in zip(a, b)] for a, b in zip(first[1], second[1])]
    operation = rng.choice(list(PLAIN))
    function.lines.append(f"  {name} = {operation} {kind_text} {first[0]}, {second[0]}")
    return name, [[PLAIN[operation](x, y, kind) % (1 << kind) for x, y in zip(a, b)] for a, b in zip(first[1], second[1])]


def through_vector(function, kind):
    if kind == FLOAT or kind % 8:
        return
    length = function.rng.choice(VECTOR_LENGTHS)
    first, second = vector_of(function, kind, length), vector_of(function, kind, length)
    for _ in range(function.rng.randint(0, 2)):
        first, second = vector_operation(function, kind, length, first, second), first
    text, places = index(function, length)
    function.add(kind, f"extractelement <{length} x i{kind}> {first[0]}, i32 {text}",
                 [elements[at] for elements, at in zip(first[1], places)])
