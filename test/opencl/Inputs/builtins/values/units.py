"""A unit runs one overload of a function on the device and judges what it gave.

Its text is the body of a kernel whose work-item `i` (of its group `lid`) has these names:

- `in`, `constants`: the inputs, in global and in constant memory
- `out`: the outputs
- `shared`: SHARED bytes of local memory for each work-item of the group

Inputs and outputs are named by $I0, $I1... and $O0, $O1... in the text: their places in memory. Images are $M0, $M1...
"""

import math
import re

import numpy as np

from declarations import POINTER

from .columns import stored
from .formats import Vector

# Enough for the largest vector, and two more.
SHARED = 3 * 128


class Overload:
    """One declaration of a function."""

    def __init__(self, name, result, parameters):
        self.name, self.result = name, result
        self.parameters = [p.strip() for p in parameters]

    def __str__(self):
        return f"{self.result} {self.name}({', '.join(self.parameters)})"

    def kind(self, number):
        """What the parameter is: (type, space), where the space of a value is None and that of a generic pointer ''."""
        text = self.parameters[number]
        pointer = POINTER.match(text)
        if pointer:
            words = pointer[1].split()
            space = next((s for s in ("global", "local", "constant", "private") if s in words), "")
            return pointer[2], space
        words = [w for w in text.split() if w not in ("const", "volatile")]
        return words[0], None

    def kinds(self):
        return [self.kind(i) for i in range(len(self.parameters))]

    def values(self):
        """Types of all parameters, or None where one is no number or vector of numbers."""
        kinds = self.kinds()
        if all(space is None and Vector.known(name) for name, space in kinds):
            return [Vector(name) for name, _ in kinds]
        return None


class Unit:
    def __init__(self, overload, items, group, inputs, output_sizes, text, check, columns=None):
        self.overload, self.items, self.group, self.text = overload, items, group, text
        self.inputs, self.output_sizes = inputs, output_sizes
        # Of values/images.py; what is in those that are written follows the outputs.
        self.images = []
        # Takes the outputs as bytes, gives a line for each mismatch.
        self.check = check
        # The values of each parameter that is no pointer, one item's after the other's; None where it is not said.
        self.columns = columns


class AnyOf(tuple):
    """Several results of which each is right."""

    def accepts(self, got):
        return any(agrees(got, wanted) for wanted in self)


class Near:
    """A result that may be off by so much."""

    def __init__(self, value, tolerance):
        self.value, self.tolerance = value, tolerance

    def accepts(self, got):
        return math.isfinite(got) and abs(got - self.value) <= self.tolerance

    def __repr__(self):
        return f"{show(float(self.value))} +- {show(float(self.tolerance))}"


class AnyNan:
    """Any NaN, among results that are taken as bits."""

    def __init__(self, kind):
        self.kind = kind

    def accepts(self, got):
        return math.isnan(self.kind.of_pattern(got))

    def __repr__(self):
        return "nan"


# The result that a reference gives where the standard promises none.
UNDEFINED = None


def agrees(got, wanted):
    if wanted is UNDEFINED:
        return True
    if hasattr(wanted, "accepts"):
        return wanted.accepts(got)
    if isinstance(wanted, float):
        if math.isnan(wanted) or math.isnan(got):
            return math.isnan(wanted) and math.isnan(got)
        return got == wanted and math.copysign(1, got) == math.copysign(1, wanted)
    return got == wanted


def show(value):
    return value.hex() if isinstance(value, float) else str(value)


def compared(output, kind, wanted, arguments):
    """Lines for the elements of an output that are not what is wanted; arguments gives those of element k."""
    lines = []
    for k, (got, want) in enumerate(zip(np.frombuffer(output, kind.storage).tolist(), wanted)):
        if not agrees(got, want):
            lines.append(f"({', '.join(map(show, arguments(k)))}) gave {show(got)}, not {show(want)}")
    return lines


def group_of(items):
    """The size of a launch's groups: full warps, parts of one, or loops."""
    return next(g for g in (48, 30, 32, 20, 16, 15, 12, 10, 1) if items % g == 0)


def load(vector, place, index="i", space="global"):
    """A value from a packed array."""
    base = "constants" if space == "constant" else "in"
    pointer = f"(({space} const {{}} *)({base} + {place}))"
    if vector.width == 3:
        p = pointer.format(vector.element.name)
        return f"({vector.name})({p}[3 * ({index})], {p}[3 * ({index}) + 1], {p}[3 * ({index}) + 2])"
    return pointer.format(vector.name) + f"[{index}]"


def store(vector, place, value, index="i"):
    """A statement that puts a value into a packed array."""
    pointer = f"((global {{}} *)(out + {place}))"
    if vector.width == 3:
        p = pointer.format(vector.element.name)
        return "".join(f"{p}[3 * ({index}) + {k}] = {value}.s{k}; " for k in range(3))
    return pointer.format(vector.name) + f"[{index}] = {value}; "


def pointer_to(vector, space, place):
    """(statements before a call, a pointer to a place of the work-item's own, statements that put what is there out)"""
    if space == "global":
        # A vector of three takes the place of four.
        return "", f"((global {vector.name} *)(out + {place}) + i)", ""
    if space == "local":
        pointer = f"((local {vector.name} *)(shared + {SHARED} * lid))"
        return "", pointer, store(vector, place, f"(*{pointer})")
    return f"{vector.name} stored{place[1:]}; ", f"&stored{place[1:]}", store(vector, place, f"stored{place[1:]}")


def componentwise(overload, table, reference, bits=None, results=None):
    """A unit of a function that does the same to each component.

    table: a column of values for each parameter that is no pointer. A parameter that is a scalar beside vectors has one
    value for each vector. reference: takes the values of a component, gives its result, or a tuple of the results if the
    function writes some through pointers. Instead of a reference, results(arguments, outputs) gives the lines itself:
    arguments are the rows, outputs the values of each result. bits: the whole type as which all numbers are taken.
    """
    kinds = overload.kinds()
    width = max(Vector(name).width for name, _ in kinds)
    rows = len(table[0])
    items = rows // width
    names, inputs, statements, arguments, afterwards, outputs, spread = [], [], "", [], "", [], []
    result = Vector(overload.result)
    outputs.append(result)
    for name, space in kinds:
        vector = Vector(name)
        if space is None:
            column = table[len(inputs)]
            statements += f"{name} a{len(inputs)} = {load(vector, f'$I{len(inputs)}')}; "
            arguments.append(f"a{len(inputs)}")
            if vector.width < width:
                column = column[:items]
                spread.append([v for v in column for _ in range(width)])
            else:
                spread.append(column)
            inputs.append(stored(column, bits or vector.element))
        else:
            before, pointer, after = pointer_to(vector, space, f"$O{len(outputs)}")
            statements += before
            arguments.append(pointer)
            afterwards += after
            outputs.append(vector)
    sizes = []
    for number, vector in enumerate(outputs):
        direct = number and vector.width == 3 and any(s == "global" for _, s in kinds)
        sizes.append(items * (4 if direct else vector.width) * vector.element.storage.itemsize)
    text = f"{statements}{result.name} r = {overload.name}({', '.join(arguments)}); " + store(result, "$O0", "r") + afterwards
    rows_of = list(zip(*spread))

    def values(output, number):
        vector = outputs[number]
        array = np.frombuffer(output, (bits or vector.element).storage)
        if array.size > rows:
            array = array.reshape(items, 4)[:, :3].reshape(-1)
        return array

    def check(found):
        arrays = [values(f, n) for n, f in enumerate(found)]
        if results:
            return results(rows_of, [a.tolist() for a in arrays])
        wanted = [reference(*row) for row in rows_of]
        if len(outputs) > 1:
            wanted = list(zip(*wanted))
        else:
            wanted = [wanted]
        return [line for a, v, w in zip(arrays, outputs, wanted)
                for line in compared(a, bits or v.element, w, lambda k: rows_of[k])]

    return Unit(overload, items, group_of(items), inputs, sizes, text, check, None if bits else table)
