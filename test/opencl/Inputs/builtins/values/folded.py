"""Calls whose arguments the compiler knows, or knows something of, and whose results it uses further.

A unit runs its function on values from memory. Here a few of these calls are added to it again: arguments are constants,
or values from memory whose bits or range the program shows, and which it does not change. Of each result one component is
stored, and something that is computed from it. The component must be right, as another result of the unit would be, and
what is computed must fit to it: a compiler that takes a result for impossible gets one of them wrong.
"""

import random

import numpy as np

from .columns import drawn, specials
from .formats import Vector, whole_of
from .units import agrees, load, show

CALLS = 6


def literal(kind, value):
    """A constant of an element type."""
    text = f"0x{kind.pattern(value):x}{'ul' if kind.bits == 64 else 'u'}"
    return f"as_{kind.name}(({whole_of(kind, False).name}){text})" if kind.real else f"({kind.name}){text}"


def constant(vector, values):
    elements = ", ".join(literal(vector.element, v) for v in values)
    return f"({vector.name})({elements})" if vector.width > 1 else elements


def bits_of(vector, signed=False):
    """The type of whole numbers with the same elements."""
    return Vector(whole_of(vector.element, signed).name + (str(vector.width) if vector.width > 1 else ""))


def with_known_bits(vector, text, values, source):
    """Some bits are known to be 0, or to be 1."""
    bits = bits_of(vector)
    patterns = [vector.element.pattern(v) for v in values]
    noise = source.getrandbits(bits.element.bits)
    if source.random() < 0.5:
        operator, masks = "&", [p | noise for p in patterns]
    else:
        operator, masks = "|", [p & noise for p in patterns]
    return f"as_{vector.name}(({bits.name})(as_{bits.name}({text}) {operator} {constant(bits, masks)}))"


def with_known_range(vector, text, values, source):
    """Between two constants."""
    kind = vector.element
    if kind.real and any(v != v or v == 0 for v in values):
        return text
    ends = [s for s in specials(kind) if s == s]
    low, high = ([choice(v, source.choice(ends)) for v in values] for choice in (min, max))
    least, most = ("fmin", "fmax") if kind.real else ("min", "max")
    return f"{least}({most}({text}, {constant(vector, low)}), {constant(vector, high)})"


def with_known_sign(vector, text, values, source):
    """Of fewer bits than the type has, which are extended."""
    kind = vector.element
    if kind.real:
        return f"fabs({text})" if all(np.copysign(1, v) > 0 and v == v for v in values) else text
    least = max((v if v >= 0 else ~v).bit_length() for v in values) + kind.signed
    shift = source.randint(0, kind.bits - max(least, 1))
    return f"({vector.name})(({vector.name})({text} << ({vector.name}){shift}) >> ({vector.name}){shift})"


FORMS = (lambda vector, text, values, source: constant(vector, values), with_known_bits, with_known_range, with_known_sign,
         lambda vector, text, values, source: text)


def whole_uses(kind):
    """What is computed from a whole number x and a constant c of its type: (text, the same in Python)."""
    u, bits, pattern = whole_of(kind, False).name, kind.bits, kind.pattern
    return (
        ("{x} > {c}", lambda x, c: x > c),
        ("{x} == {c}", lambda x, c: x == c),
        ("{x} < {c} ? 3 : 5", lambda x, c: 3 if x < c else 5),
        (f"({{x}} >> {bits - 1}) & 1", lambda x, c: x >> bits - 1 & 1),
        (f"({u}){{x}} >> {bits - 1}", lambda x, c: pattern(x) >> bits - 1),
        (f"({u}){{x}} / ({u})3", lambda x, c: pattern(x) // 3),
        (f"({u}){{x}} % ({u})10", lambda x, c: pattern(x) % 10),
        (f"({u})(({u}){{x}} + ({u}){{c}})", lambda x, c: pattern(x + c)),
        (f"({u})({{x}} & {{c}})", lambda x, c: pattern(x & c)),
        (f"({u})max({{x}}, {{c}})", lambda x, c: pattern(max(x, c))),
        (f"({u})abs({{x}})", lambda x, c: abs(x)),
        ("(long){x}", lambda x, c: x),
        (f"{{x}} ? clz({{x}}) : ({kind.name})77", lambda x, c: bits - pattern(x).bit_length() if x else 77),
        (f"popcount(({kind.name})({{x}} ^ {{c}}))", lambda x, c: pattern(x ^ c).bit_count()),
    )


def real_uses(kind):
    return (
        ("{x} > {c}", lambda x, c: x > c),
        ("{x} == {c}", lambda x, c: x == c),
        ("{x} < {c} ? 3 : 5", lambda x, c: 3 if x < c else 5),
        ("!({x} < {c})", lambda x, c: not x < c),
        ("{x} >= 0 ? 3 : 5", lambda x, c: 3 if x >= 0 else 5),
        ("{x} != {x}", lambda x, c: x != x),
        ("isnan({x}) + 2 * isinf({x})", lambda x, c: (x != x) + 2 * bool(np.isinf(x))),
        ("isfinite({x})", lambda x, c: bool(np.isfinite(x))),
        ("fabs({x}) < {c}", lambda x, c: abs(x) < c),
        ("isnan({x}) ? 7 : signbit({x})", lambda x, c: 7 if x != x else bool(np.signbit(x))),
    )


def place_of(unit, source):
    """An item and a component of it, every other time one whose arguments are special values."""
    vectors = [Vector(name) for name, space in unit.overload.kinds() if space is None]
    width = max((v.width for v in vectors), default=1)
    component = source.randrange(width)
    known = [{v.element.pattern(s) for s in specials(v.element)} for v in vectors]
    special = [i for i in range(unit.items)
               if all(v.element.pattern(column[i * v.width + component % v.width]) in s
                      for v, column, s in zip(vectors, unit.columns, known))]
    return source.choice(special if special and source.random() < 0.5 else range(unit.items)), component


class Call:
    """A call with the arguments of an item, and what it stores: two numbers."""

    def __init__(self, unit, place, source):
        overload, table = unit.overload, unit.columns
        self.item, self.component = place_of(unit, source)
        declared, arguments, outputs = "", [], [(Vector(overload.result), "r")]
        column = iter(enumerate(table))
        for name, space in overload.kinds():
            vector = Vector(name)
            if space is None:
                number, values = next(column)
                text = load(vector, f"$I{number}", self.item)
                values = values[self.item * vector.width:][:vector.width]
                arguments.append(source.choice(FORMS)(vector, text, values, source))
            else:
                declared += f"{name} p{len(outputs)}; "
                arguments.append(f"&p{len(outputs)}")
                outputs.append((vector, f"p{len(outputs)}"))
        self.output = source.randrange(len(outputs))
        vector, name = outputs[self.output]
        self.kind, self.component = vector.element, self.component % vector.width
        component = f"{name}.s{self.component:x}" if vector.width > 1 else name
        use, self.use = source.choice(real_uses(self.kind) if self.kind.real else whole_uses(self.kind))
        self.other = source.choice(specials(self.kind) + [drawn(self.kind, source)])
        bits = f"as_{whole_of(self.kind, False).name}(x)" if self.kind.real else f"({whole_of(self.kind, False).name})x"
        self.shown = f"{overload.name}({', '.join(arguments)})"
        self.used = use.format(x="x", c=literal(self.kind, self.other))
        self.text = (f"{{ {declared}{overload.result} r = {self.shown}; {self.kind.name} x = {component}; "
                     f"folded[{place}] = {bits}; folded[{place + 1}] = (ulong)({self.used}); }} ")

    def lines(self, judge, items, found, stored):
        """found: the outputs of the unit, which judge takes."""
        value = self.kind.of_pattern(int(stored[0]) & (1 << self.kind.bits) - 1)
        array = np.frombuffer(found[self.output], self.kind.storage).copy()
        place = self.item * (array.size // items) + self.component
        lines = []
        if not agrees(value, array[place].item()):
            # Another right result may be there.
            array[place] = value
            lines = judge([*found[:self.output], array.tobytes(), *found[self.output + 1:]])
        wanted = int(self.use(value, self.other)) & (1 << 64) - 1
        if int(stored[1]) != wanted:
            lines.append(f"x = {show(value)}: {self.used} gave {stored[1]}, not {wanted}")
        return [f"{self.shown}: {line}" for line in lines]


def fold(unit, seed):
    """Adds calls to a unit whose function takes values only, and has results through pointers at most."""
    overload = unit.overload
    if unit.columns is None or any(space not in (None, "", "private") for _, space in overload.kinds()):
        return
    source = random.Random(f"{seed} {overload}")
    calls = [Call(unit, 2 * n, source) for n in range(CALLS)]
    unit.text += (f"global ulong *folded = (global ulong *)(out + $O{len(unit.output_sizes)}); "
                  + "".join(call.text for call in calls))
    unit.output_sizes.append(16 * CALLS)
    judge = unit.check

    def check(outputs):
        *found, stored = outputs
        lines = judge(found)
        # What is wrong from memory is wrong here, too.
        if lines:
            return lines
        numbers = np.frombuffer(stored, np.uint64)
        return [line for n, call in enumerate(calls) for line in call.lines(judge, unit.items, found, numbers[2 * n:])]

    unit.check = check
