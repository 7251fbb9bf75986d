#!/usr/bin/env python3
"""Functions of random LLVM code, compared with Python's numbers.

C reaches few of the operations that an optimiser makes: integers of odd widths, funnel shifts, saturating and overflowing
arithmetic, flags such as nsw, constants that stay in one place for several uses. Here they are written as LLVM's code. A function
is a row of them on two arguments, some behind a branch, with local variables and vectors. Each is computed for the values that the lanes will have as it is
written, so that none of them is undefined and every flag is true; some functions go through LLVM's own optimiser first.

exit codes: 0 no difference, 1 a function differs or is refused (the seed's files are kept), 2 usage
"""

import copy
import math
import random
import sys

import fp32
import functions
from functions import LANES, signed
from ir_memory import Variable, through_memory, through_vector
from ir_operations import FLOAT, Value, operate, type_of

FUNCTIONS = 40
WIDTHS = [8, 16, 32, 32, 64, 64, 1, 3, 7, 13, 24, 31, 33, 40, 48, 63]
# Zeros, one, halves, infinity, the largest, the least, what an i32 just holds, and a NaN.
FLOAT_WORDS = [0, 1 << 31, 0x3F800000, 0xBF000000, 0x40200000, 0x7F800000, 0x7F7FFFFF, 1, 0x4F000000, 0xCF000000, 0x7FC00000]
PASSES = "default<O2>"


class Function:
    """Its text, and what it gives for each lane."""

    def __init__(self, rng, number, given):
        self.rng, self.lines, self.names, self.labels = rng, [], 0, 0
        self.allocations, self.variables = [], []
        self.pool = [Value(64, "%x", [first for first, _ in given]), Value(64, "%y", [second for _, second in given])]
        self.row(rng.randint(2, 6))
        for _ in range(rng.choice([0, 0, 1, 1, 2])):
            self.branch()
            self.row(rng.randint(1, 4))
        self.results = self.end()
        self.text = "\n".join([f"define i64 @f{number}(i64 %x, i64 %y) {{", "entry:", *self.allocations, *self.lines, "}", ""])

    def name(self):
        self.names += 1
        return f"%v{self.names}"

    def width(self):
        return self.rng.choice(WIDTHS)

    def add(self, kind, text, values):
        value = Value(kind, self.name(), values)
        self.lines.append(f"  {value.name} = {text}")
        self.pool.append(value)
        return value

    def row(self, count):
        for _ in range(count):
            kind = FLOAT if self.rng.random() < 0.15 else self.width()
            further = self.rng.random()
            (through_memory if further < 0.1 else through_vector if further < 0.15 else operate)(self, kind)

    def of_kind(self, kind, constants=True):
        """A value of the pool as that type, or a constant; half of these are opaque."""
        rng = self.rng
        if constants and rng.random() < 0.3:
            if kind == FLOAT:
                number = fp32.of_bits(rng.choice(FLOAT_WORDS + [rng.getrandbits(30)]))
                return Value(FLOAT, fp32.text(number), [number] * LANES)
            number = functions.constant(rng, kind)
            if rng.random() < 0.5:
                return Value(kind, str(number), [number] * LANES)
            return self.add(kind, f"bitcast i{kind} {number} to i{kind}", [number] * LANES)
        fitting = [value for value in self.pool if value.kind == kind]
        if rng.random() < (0.7 if len(fitting) > 1 else 0.3 if fitting else 0):
            return rng.choice(fitting[-6:])
        return self.converted(rng.choice(self.pool[-8:]), kind)

    def converted(self, value, kind):
        if value.kind == kind:
            return value
        if value.kind == FLOAT and not any(map(math.isnan, value.values)):
            value = self.add(32, f"bitcast float {value.name} to i32", [fp32.bits(number) for number in value.values])
            return self.converted(value, kind)
        if value.kind == FLOAT:
            value = self.add(1, f"fcmp olt float {value.name}, 1.0", [number < 1 for number in value.values])
            return self.converted(value, kind)
        if kind == FLOAT:
            value = self.converted(value, 24)
            return self.add(FLOAT, f"sitofp i24 {value.name} to float", [float(signed(number, 24)) for number in value.values])
        if kind < value.kind:
            return self.add(kind, f"trunc i{value.kind} {value.name} to i{kind}", [number % (1 << kind) for number in value.values])
        if self.rng.random() < 0.5:
            return self.add(kind, f"zext i{value.kind} {value.name} to i{kind}", value.values)
        return self.add(kind, f"sext i{value.kind} {value.name} to i{kind}",
                        [signed(number, value.kind) % (1 << kind) for number in value.values])

    def branch(self):
        """Two sides whose values meet in a phi; where one has none of its own, it gives an older value."""
        condition = self.of_kind(1, constants=False)
        self.labels += 1
        label = f"b{self.labels}"
        kind = FLOAT if self.rng.random() < 0.15 else self.width()
        sides, pool, variables = [], list(self.pool), self.variables
        self.lines.append(f"  br i1 {condition.name}, label %{label}.then, label %{label}.else")
        for side in ("then", "else"):
            self.pool, self.variables = list(pool), copy.deepcopy(variables)
            self.lines.append(f"{label}.{side}:")
            self.row(self.rng.randint(0, 3))
            sides.append((self.of_kind(kind), self.variables))
            self.lines.append(f"  br label %{label}.end")
        self.pool = pool
        self.lines.append(f"{label}.end:")
        (then, then_variables), (other, other_variables) = sides
        # A variable that one side alone has is not seen behind it.
        self.variables = [Variable(variable.name, [(a if take else b).lanes[lane] for lane, take in enumerate(condition.values)])
                          for variable, a, b in zip(variables, then_variables, other_variables)]
        self.add(kind, f"phi {type_of(kind)} [ {then.name}, %{label}.then ], [ {other.name}, %{label}.else ]",
                 [a if take else b for take, a, b in zip(condition.values, then.values, other.values)])

    def end(self):
        """Returns what comes of the last values together."""
        result = self.converted(self.pool[-1], 64)
        for value in {value.name: value for value in self.pool[-4:-1]}.values():
            other = self.converted(value, 64)
            result = self.add(64, f"xor i64 {result.name}, {other.name}", [a ^ b for a, b in zip(result.values, other.values)])
            result = self.add(64, f"call i64 @llvm.fshl.i64(i64 {result.name}, i64 {result.name}, i64 9)",
                              [(a << 9 | a >> 55) % (1 << 64) for a in result.values])
        self.lines.append(f"  ret i64 {result.name}")
        return result.values


def check(seed, folder):
    rng = random.Random(seed)
    configuration = functions.configuration_of(seed // 2)
    given = list(zip(functions.values(rng, 64), functions.values(rng, rng.choice([8, 32, 64]))))
    made = [Function(rng, number, given) for number in range(FUNCTIONS)]
    before = [f"-passes={PASSES}", "-mtriple=riscv32"] if seed % 2 else []

    def difference(number, results):
        for (x, y), result, wanted in zip(given, results, made[number].results):
            if result != wanted:
                return f"f{number}({x:#x}, {y:#x}) gives {result:#x}, expected {wanted:#x}"
        return None

    text = "".join(function.text for function in made)
    return functions.check(seed, f"{configuration}{', optimised before' if before else ''}", FUNCTIONS,
                           lambda: functions.compute(text, given, FUNCTIONS, folder, configuration, before), difference)


if __name__ == "__main__":
    sys.exit(functions.main(__doc__, "ir-functions", FUNCTIONS, check))
