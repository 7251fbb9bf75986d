"""LLVM's operations as Python computes them, for ir_functions.py. Integers are numbers without sign below 2 to their width."""

import dataclasses
import math
import operator

import fp32
from functions import quotient, signed

FLOAT = "float"


@dataclasses.dataclass(frozen=True)
class Value:
    """Of a function: its type (a width, or FLOAT), its name, and what each lane has there."""
    kind: object
    name: str
    values: list


def type_of(kind):
    return FLOAT if kind == FLOAT else f"i{kind}"


def of_signed(compute):
    return lambda a, b, width: compute(signed(a, width), signed(b, width))


def saturated(value, least, most):
    return min(max(value, least), most)


def without_sign(compute):
    """Saturates to numbers without sign."""
    return lambda a, b, width: saturated(compute(a, b), 0, (1 << width) - 1)


def with_sign(compute):
    return lambda a, b, width: saturated(compute(signed(a, width), signed(b, width)), -(1 << width - 1), (1 << width - 1) - 1)


def divided(compute):
    """None where it overflows: the least number divided by -1."""
    def result(a, b, width):
        a, b = signed(a, width), signed(b, width)
        return None if a == -(1 << width - 1) and b == -1 else compute(a, b)
    return result


def order(a, b):
    return (a > b) - (a < b)


PLAIN = {  # the exact result, of which the width's bits are kept
    "add": lambda a, b, _: a + b,
    "sub": lambda a, b, _: a - b,
    "mul": lambda a, b, _: a * b,
    "and": lambda a, b, _: a & b,
    "or": lambda a, b, _: a | b,
    "xor": lambda a, b, _: a ^ b,
}
SHIFTS = {
    "shl": lambda a, b, _: a << b,
    "lshr": lambda a, b, _: a >> b,
    "ashr": lambda a, b, width: signed(a, width) >> b,
    "@llvm.ushl.sat": lambda a, b, width: min(a << b, (1 << width) - 1),
    "@llvm.sshl.sat": lambda a, b, width: saturated(signed(a, width) << b, -(1 << width - 1), (1 << width - 1) - 1),
}
DIVISIONS = {
    "udiv": lambda a, b, _: a // b,
    "urem": lambda a, b, _: a % b,
    "sdiv": divided(quotient),
    "srem": divided(lambda a, b: a - b * quotient(a, b)),
}
CALLS = {
    "@llvm.smin": of_signed(min),
    "@llvm.smax": of_signed(max),
    "@llvm.umin": lambda a, b, _: min(a, b),
    "@llvm.umax": lambda a, b, _: max(a, b),
    "@llvm.uadd.sat": without_sign(operator.add),
    "@llvm.usub.sat": without_sign(operator.sub),
    "@llvm.sadd.sat": with_sign(operator.add),
    "@llvm.ssub.sat": with_sign(operator.sub),
}
OVERFLOWING = {"add": operator.add, "sub": operator.sub, "mul": operator.mul}
COMPARISONS = {
    "eq": lambda a, b, _: a == b,
    "ne": lambda a, b, _: a != b,
    "ult": lambda a, b, _: a < b,
    "ule": lambda a, b, _: a <= b,
    "ugt": lambda a, b, _: a > b,
    "uge": lambda a, b, _: a >= b,
    "slt": of_signed(operator.lt),
    "sle": of_signed(operator.le),
    "sgt": of_signed(operator.gt),
    "sge": of_signed(operator.ge),
}
ONE_OPERAND = {  # with what LLVM's function takes behind it
    "@llvm.ctpop": (lambda a, _: a.bit_count(), ""),
    "@llvm.ctlz": (lambda a, width: width - a.bit_length(), ", i1 false"),
    "@llvm.cttz": (lambda a, width: (a & -a).bit_length() - 1 if a else width, ", i1 false"),
    "@llvm.bitreverse": (lambda a, width: int(f"{a:0{width}b}"[::-1], 2), ""),
    "@llvm.bswap": (lambda a, width: int.from_bytes(a.to_bytes(width // 8, "little"), "big"), ""),
    "@llvm.abs": (lambda a, width: abs(signed(a, width)), ", i1 false"),
}
FLOAT_COMPARISONS = {  # what ordered numbers give; u... are also true where one is NaN
    "oeq": operator.eq, "ogt": operator.gt, "oge": operator.ge, "olt": operator.lt, "ole": operator.le,
    "one": operator.ne, "ord": lambda a, b: True,
    "ueq": operator.eq, "ugt": operator.gt, "uge": operator.ge, "ult": operator.lt, "ule": operator.le,
    "une": operator.ne, "uno": lambda a, b: False,
}


def true_flags(rng, name, width, exact, lanes):
    """Those of an operation that hold for all lanes, of which half are written. `lanes` are its operands."""
    flags = []
    if name in ("add", "sub", "mul", "shl"):
        with_signs = [{"add": operator.add, "sub": operator.sub, "mul": operator.mul, "shl": lambda a, b: a << b}[name](
            signed(a, width), b if name == "shl" else signed(b, width)) for a, b in lanes]
        if all(-(1 << width - 1) <= result < 1 << width - 1 for result in with_signs):
            flags.append("nsw")
        if all(0 <= result < 1 << width for result in exact):
            flags.append("nuw")
    if name == "or" and all(a & b == 0 for a, b in lanes):
        flags.append("disjoint")
    if name in ("lshr", "ashr") and all(a % (1 << b) == 0 for a, b in lanes):
        flags.append("exact")
    if name == "udiv" and all(a % b == 0 for a, b in lanes):
        flags.append("exact")
    if name == "sdiv" and all(signed(a, width) % signed(b, width) == 0 for a, b in lanes):
        flags.append("exact")
    return "".join(f" {flag}" for flag in flags if rng.random() < 0.5)


def binary(function, name, kind, first, second, compute):
    """Nothing where a lane's result is undefined."""
    lanes = list(zip(first.values, second.values))
    exact = [compute(a, b, kind) for a, b in lanes]
    if None in exact:
        return
    results = [int(result) % (1 << kind) for result in exact]
    if name.startswith("@"):
        text = f"call i{kind} {name}.i{kind}(i{kind} {first.name}, i{kind} {second.name})"
    else:
        text = f"{name}{true_flags(function.rng, name, kind, exact, lanes)} i{kind} {first.name}, {second.name}"
    function.add(kind, text, results)


def plain(function, kind):
    name = function.rng.choice([*PLAIN, *CALLS])
    binary(function, name, kind, function.of_kind(kind), function.of_kind(kind), PLAIN.get(name) or CALLS[name])


def below(function, kind):
    """A value for the amount of a shift: a constant, or one whose high bits are cut off."""
    if function.rng.random() < 0.6:
        amount = function.rng.randrange(kind)
        return Value(kind, str(amount), [amount] * len(function.pool[0].values))
    mask = (1 << kind.bit_length() - 1) - 1
    value = function.of_kind(kind, constants=False)
    return function.add(kind, f"and i{kind} {value.name}, {mask}", [number & mask for number in value.values])


def shift(function, kind):
    name = function.rng.choice(list(SHIFTS))
    if kind == 1:
        return
    binary(function, name, kind, function.of_kind(kind), below(function, kind), SHIFTS[name])


def funnel(function, kind):
    if kind == 1:
        return
    first, second = function.of_kind(kind), function.of_kind(kind)
    second = first if function.rng.random() < 0.4 else second
    amount, left = function.of_kind(kind), function.rng.random() < 0.5
    results = []
    for a, b, by in zip(first.values, second.values, amount.values):
        both, by = a << kind | b, by % kind
        results.append((both << by >> kind if left else both >> by) % (1 << kind))
    name = "fshl" if left else "fshr"
    function.add(kind, f"call i{kind} @llvm.{name}.i{kind}(i{kind} {first.name}, i{kind} {second.name}, i{kind} {amount.name})", results)


def division(function, kind):
    name, divisor = function.rng.choice(list(DIVISIONS)), function.of_kind(kind)
    if 0 in divisor.values:
        divisor = function.add(kind, f"or i{kind} {divisor.name}, 1", [number | 1 for number in divisor.values])
    binary(function, name, kind, function.of_kind(kind), divisor, DIVISIONS[name])


def one_operand(function, kind):
    name = function.rng.choice(list(ONE_OPERAND))
    if name == "@llvm.bswap" and kind % 16:
        return
    compute, further = ONE_OPERAND[name]
    value = function.of_kind(kind, constants=False)
    function.add(kind, f"call i{kind} {name}.i{kind}(i{kind} {value.name}{further})",
                 [compute(number, kind) % (1 << kind) for number in value.values])


def overflowing(function, kind):
    """Both parts of the result, so that each has a use now and then."""
    rng = function.rng
    name, has_sign = rng.choice(list(OVERFLOWING)), rng.random() < 0.5
    first, second = function.of_kind(kind), function.of_kind(kind)
    low, high = (-(1 << kind - 1), (1 << kind - 1) - 1) if has_sign else (0, (1 << kind) - 1)
    exact = [OVERFLOWING[name](*(signed(number, kind) if has_sign else number for number in pair))
             for pair in zip(first.values, second.values)]
    pair = function.name()
    function.lines.append(f"  {pair} = call {{i{kind}, i1}} @llvm.{'s' if has_sign else 'u'}{name}.with.overflow.i{kind}"
                          f"(i{kind} {first.name}, i{kind} {second.name})")
    function.add(1, f"extractvalue {{i{kind}, i1}} {pair}, 1", [int(not low <= result <= high) for result in exact])
    if rng.random() < 0.8:
        function.add(kind, f"extractvalue {{i{kind}, i1}} {pair}, 0", [result % (1 << kind) for result in exact])


def three_way(function, kind):
    if kind < 2:
        return
    width, has_sign = function.width(), function.rng.random() < 0.5
    first, second = function.of_kind(width), function.of_kind(width)
    results = [order(*((signed(a, width), signed(b, width)) if has_sign else (a, b))) % (1 << kind)
               for a, b in zip(first.values, second.values)]
    name = "scmp" if has_sign else "ucmp"
    function.add(kind, f"call i{kind} @llvm.{name}.i{kind}.i{width}(i{width} {first.name}, i{width} {second.name})", results)


def select(function, kind):
    condition = function.of_kind(1, constants=False)
    first, second = function.of_kind(kind), function.of_kind(kind)
    name = type_of(kind)
    function.add(kind, f"select i1 {condition.name}, {name} {first.name}, {name} {second.name}",
                 [a if take else b for take, a, b in zip(condition.values, first.values, second.values)])


def comparison(function, _):
    rng = function.rng
    if rng.random() < 0.3:
        first, second = function.of_kind(FLOAT), function.of_kind(FLOAT)
        name = rng.choice(list(FLOAT_COMPARISONS))
        results = [name.startswith("u") if math.isnan(a) or math.isnan(b) else FLOAT_COMPARISONS[name](a, b)
                   for a, b in zip(first.values, second.values)]
        function.add(1, f"fcmp {name} float {first.name}, {second.name}", [int(result) for result in results])
        return
    width, name = function.width(), rng.choice(list(COMPARISONS))
    first, second = function.of_kind(width), function.of_kind(width)
    function.add(1, f"icmp {name} i{width} {first.name}, {second.name}",
                 [int(COMPARISONS[name](a, b, width)) for a, b in zip(first.values, second.values)])


def to_integer(function, kind):
    """Of a float: saturated, or its bits. Those of a NaN are not said by LLVM."""
    value = function.of_kind(FLOAT)
    if kind == 32 and function.rng.random() < 0.5:
        if not any(map(math.isnan, value.values)):
            function.add(32, f"bitcast float {value.name} to i32", [fp32.bits(number) for number in value.values])
        return
    has_sign = function.rng.random() < 0.5
    low, high = (-(1 << kind - 1), (1 << kind - 1) - 1) if has_sign else (0, (1 << kind) - 1)
    results = []
    for number in value.values:
        if math.isnan(number):
            results.append(0)
        else:
            results.append((saturated(int(number), low, high) if math.isfinite(number) else low if number < 0 else high) % (1 << kind))
    name = "fptosi" if has_sign else "fptoui"
    function.add(kind, f"call i{kind} @llvm.{name}.sat.i{kind}.f32(float {value.name})", results)


def to_float(function, _):
    width = function.width()
    value, has_sign = function.of_kind(width, constants=False), function.rng.random() < 0.5
    if width == 32 and function.rng.random() < 0.5:
        numbers = [fp32.of_bits(number) for number in value.values]
        if not any(map(math.isnan, numbers)):
            function.add(FLOAT, f"bitcast i32 {value.name} to float", numbers)
        return
    name = "sitofp" if has_sign else "uitofp"
    function.add(FLOAT, f"{name} i{width} {value.name} to float",
                 [fp32.nearest(signed(number, width) if has_sign else number) for number in value.values])


def float_arithmetic(function, _):
    name = function.rng.choice(list(fp32.OPERATIONS))
    compute, count = fp32.OPERATIONS[name]
    operands = [function.of_kind(FLOAT) for _ in range(count)]
    if name == "@llvm.copysign" and any(map(math.isnan, operands[1].values)):
        return
    results = [compute(*lane) for lane in zip(*(operand.values for operand in operands))]
    if name.startswith("@"):
        text = f"call float {name}.f32({', '.join(f'float {operand.name}' for operand in operands)})"
    else:
        text = f"{name} float {', '.join(operand.name for operand in operands)}"
    function.add(FLOAT, text, results)


INTEGER_CHOICES = [plain] * 6 + [shift] * 3 + [select] * 2 + [division, one_operand, funnel, overflowing, three_way, to_integer]
CHOICES = {1: [comparison] * 4 + [plain, select], FLOAT: [float_arithmetic] * 4 + [to_float, to_float, select]}


def operate(function, kind):
    """Adds an operation whose result is of that type, or nothing where chance asks for one that is undefined."""
    function.rng.choice(CHOICES.get(kind, INTEGER_CHOICES))(function, kind)
