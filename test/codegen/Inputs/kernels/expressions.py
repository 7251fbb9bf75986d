"""Random C expressions without undefined behaviour over the variables of a scope."""

import dataclasses

ROUNDINGS = ["floorf", "ceilf", "truncf", "rintf", "roundf"]
# From one call of each of kernels.h's functions: warp instructions, roughly.
LIBRARY_COST = {"early": 10, "nested": 100, "recursive": 60, "through_large": 60}


@dataclasses.dataclass
class Helper:
    """A function of the module that expressions may call: uint name(uint, uint, float)."""
    name: str
    cost: int


@dataclasses.dataclass
class Scope:
    """What the expressions of one function may use, beside `t`, the lane's number."""
    ints: list        # uint variables
    uniform: list     # uint expressions in which lanes agree, or start to
    longs: list       # ulong variables
    floats: list
    doubles: list
    words: list       # templates of uint lvalues, with {} for an index in 0..3
    readable: list = dataclasses.field(default_factory=list)  # the same, not to be assigned
    helpers: list = dataclasses.field(default_factory=list)


class Expressions:
    """Each method returns C text. `weight` is how often the code being made may run, `cost` what all of it may."""

    MAX_COST = 20_000

    def __init__(self, random, scope):
        self.random = random
        self.scope = scope
        self.weight = 1
        self.cost = 0

    def pick(self, choices):
        return self.random.choice(choices)

    def chance(self, probability):
        return self.random.random() < probability

    def one_of(self, depth, leaves, weighted):
        """A leaf at the bottom, else one of (weight, function of depth)."""
        if depth > 2 or self.chance(0.3 + 0.2 * depth):
            return self.pick(leaves)
        weights, makers = zip(*weighted)
        return self.random.choices(makers, weights)[0](depth + 1)

    def pay(self, cost):
        """Whether code of this cost may be put here; counts it if so."""
        if self.cost + self.weight * cost > self.MAX_COST:
            return False
        self.cost += self.weight * cost
        return True

    def constant(self):
        return self.pick([f"{self.random.randint(0, 9)}u", "255u", "0x80000000u", "~0u", f"{self.random.getrandbits(32)}u"])

    # --- integers ---------------------------------------------------------

    def integer(self, depth=0):
        scope = self.scope
        return self.one_of(depth, scope.ints * 3 + ["t"] + scope.uniform + [self.constant()], [
            (30, self.arithmetic), (8, self.choice_of(self.integer)), (8, self.signed), (5, self.bit_operation),
            (6, self.memory_word), (4, self.narrow), (5, self.from_float), (4, self.from_long), (4, self.division),
            (5, self.call), (2, self.from_struct), (2, lambda d: f"(uint)({self.condition(d)})")])

    def arithmetic(self, depth):
        a, b = self.integer(depth), self.integer(depth)
        return self.pick([f"({a} + {b})", f"({a} - {b})", f"({a} * {b})", f"({a} ^ {b})", f"({a} & {b})", f"({a} | {b})",
                          f"({a} & ~{b})", f"({a} << ({b} & 31))", f"({a} >> ({b} & 31))", f"(({a} << 2) + {b})"])

    def choice_of(self, kind):
        return lambda depth: f"({self.condition(depth)} ? {kind(depth)} : {kind(depth)})"

    def signed(self, depth):
        a, b = self.integer(depth), self.integer(depth)
        return self.pick([f"(uint)((int)({a}) >> ({b} & 31))", f"(uint)((int)({a}) < (int)({b}) ? {a} : {b})",
                          f"(uint)signed_div((int)({a}), (int)({b}))", f"(uint)signed_rem((int)({a}), (int)({b}))",
                          f"(uint)((long long)(int)({a}) * (int)({b}) >> 32)"])

    def bit_operation(self, depth):
        a, b = self.integer(depth), self.integer(depth)
        k = self.random.randint(1, 31)
        return self.pick([f"(uint)__builtin_popcount({a})", f"(uint)__builtin_clz(({a}) | 1)", f"(uint)__builtin_ctz(({a}) | 256)",
                          f"__builtin_bswap32({a})", f"__builtin_rotateleft32({a}, {b})", f"__builtin_rotateright32({a}, {k})",
                          f"({a} < {b} ? {a} : {b})", f"({a} ^ ~{b})"])

    def memory_word(self, depth):
        word = self.pick(self.scope.words + self.scope.readable)
        return word.format(f"({self.integer(depth + 1)}) & 3")

    def narrow(self, depth):
        return f"(uint)({self.pick(['signed char', 'uchar', 'short', 'ushort'])})({self.integer(depth)})"

    def from_float(self, depth):
        value = self.floating(depth)
        return self.pick([f"(uint)to_int({value})", f"to_uint({value})", f"bits({value})",
                          f"(uint)({value} > {self.floating(depth)})"])

    def from_long(self, depth):
        return f"(uint)({self.long(depth)} >> {self.pick(['0', '7', '32', f'({self.integer(depth)} & 63)'])})"

    def division(self, depth):
        return f"({self.integer(depth)} {self.pick('/%')} ({self.integer(depth)} | 1))"

    def call(self, depth):
        a, b = self.integer(depth), self.integer(depth)
        if self.scope.helpers and self.chance(0.5):
            helper = self.pick(self.scope.helpers)
            if self.pay(helper.cost):
                return f"{helper.name}({a}, {b}, {self.floating(depth)})"
        name = self.pick(sorted(LIBRARY_COST))
        if not self.pay(LIBRARY_COST[name]):
            return a
        return f"{name}({a}, {f'({b}) & 7' if name == 'recursive' else b})"

    def from_struct(self, depth):
        vector = f"(uint4){{{', '.join(self.integer(depth + 1) for _ in range(4))}}}"
        if not self.pay(40):
            return self.constant()
        if self.chance(0.5):
            return f"turn((pair){{{self.integer(depth)}, {self.floating(depth)}}}, {vector}).first"
        return (f"weave({vector}, (float2){{{self.floating(depth)}, {self.floating(depth)}}}, {self.integer(depth)})"
                f"{self.pick(['.x', '.w', f'[({self.integer(depth)}) & 3]'])}")

    # --- the others -------------------------------------------------------

    def long(self, depth=0):
        return self.one_of(depth, self.scope.longs * 3 + [f"((ulong)({self.integer(2)}) << 20)", "0x123456789abcull"], [
            (10, lambda d: f"({self.long(d)} {self.pick(['+', '-', '*', '^', '&', '|'])} {self.long(d)})"),
            (3, lambda d: f"({self.long(d)} {self.pick(['<<', '>>'])} ({self.integer(d)} & 63))"),
            (3, self.choice_of(self.long)), (2, lambda d: f"(ulong)((long long){self.long(d)} >> ({self.integer(d)} & 63))"),
            (1, lambda d: f"to_ulong({self.floating(d)})"), (1, self.long_division)])

    def long_division(self, depth):
        if not self.pay(150):  # in software
            return self.long(3)
        return self.pick([f"({self.long(depth)} {self.pick('/%')} ({self.long(depth)} | 1))",
                          f"(ulong)((long long)({self.long(depth)} >> 1) / (long long)(({self.integer(depth)}) | 1))"])

    def floating(self, depth=0):
        return self.one_of(depth, self.scope.floats * 5 + ["1.5f", "-0.25f", "100.0f", "-0.0f", "1e-40f", "__builtin_inff()"], [
            (10, lambda d: f"({self.floating(d)} {self.pick(['+', '-', '*', '/'])} {self.floating(d)})"),
            (5, self.choice_of(self.floating)), (2, lambda d: f"(float)(int)({self.integer(d)})"),
            (2, lambda d: f"(float)({self.integer(d)})"), (1, lambda d: f"(float)(long long)({self.long(d)})"),
            (1, lambda d: f"float_of({self.integer(d)})"), (2, lambda d: f"__builtin_{self.pick(ROUNDINGS)}({self.floating(d)})"),
            (1, lambda d: f"__builtin_fmaf({self.floating(d)}, {self.floating(d)}, {self.floating(d)})"),
            (1, lambda d: f"__builtin_sqrtf(__builtin_fabsf({self.floating(d)}))"),
            (1, lambda d: f"__builtin_copysignf({self.floating(d)}, {self.floating(d)})"),
            (2, lambda d: f"round_to({self.floating(d)}, {self.integer(d)})" if self.pay(30) else self.floating(3))])

    def double(self):
        """Double precision is in software, and slow."""
        if not self.pay(400):
            return self.pick(self.scope.doubles)
        a = self.pick(self.scope.doubles)
        return self.pick([f"({a} {self.pick('+-*/')} {self.floating(2)})", f"in_double({self.floating(1)}, {self.integer(1)})",
                          f"({self.condition(1)} ? {a} * 0.75 : (double)(int)({self.integer(1)}))"])

    def condition(self, depth=0):
        return self.one_of(min(depth, 2), [self.bit_test(depth)] * 4 + [f"({self.pick(self.scope.uniform)} & {self.pick([1, 2, 3])})"], [
            (6, lambda d: f"({self.condition(d)} {self.pick(['&&', '||'])} {self.condition(d)})" if d < 4 else self.bit_test(d)),
            (8, self.bit_test), (1, lambda d: f"!{self.bit_test(d)}"),
            (3, lambda d: f"({self.integer(2)} {self.pick(['<', '==', '>=', '!='])} {self.integer(2)})"),
            (2, lambda d: f"((int)({self.integer(2)}) {self.pick(['<', '>='])} (int)({self.integer(2)}))"),
            (4, lambda d: f"({self.pick(self.scope.floats)} {self.pick(['<', '>=', '==', '!='])} {self.floating(2)})"),
            (2, lambda d: f"({self.pick(self.scope.longs)} {self.pick(['<', '==', '>='])} {self.long(2)})")])

    def bit_test(self, _depth):
        """Bits of the lane's number are in it: lanes part as often as not."""
        mask = self.pick([1, 1, 2, 3, 4, 7])
        bound = mask if mask in (1, 2, 4) else self.random.randint(1, mask - 1)
        mixed = f"({self.integer(2)} {self.pick('+^')} t)"
        return f"(({mixed} & {mask}u) {self.pick(['==', '!=', '<', '>='])} {bound}u)"
