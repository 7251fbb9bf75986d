"""Random C statements: control flow of all kinds that ends, over a scope's variables."""

from expressions import Expressions

# What two lanes may apply to one word in any order with the same result, each kind to words of its own
# (index in SHARED_WORDS, C template with the word's address and a value).
COMMUTING = [
    (0, "__atomic_fetch_add({}, {}, 0)"), (0, "__atomic_fetch_sub({}, {}, 0)"), (1, "__atomic_fetch_or({}, {}, 0)"),
    (2, "__atomic_fetch_and({}, {}, 0)"), (3, "__atomic_fetch_xor({}, {}, 0)"),
    (4, "__atomic_fetch_min({}, {}, 0)"), (5, "__atomic_fetch_max({}, {}, 0)"),
    (6, "__atomic_fetch_min((int *){}, (int)({}), 0)"), (7, "__atomic_fetch_max((int *){}, (int)({}), 0)"),
    (8, "multiply_atomically({}, {})"),
    (9, "__atomic_fetch_add((uchar *){} + 1, (uchar)({}), 0)"), (10, "__atomic_fetch_or((ushort *){} + 1, (ushort)({}), 0)"),
    (11, "__atomic_fetch_xor((uchar *){} + 3, (uchar)({}), 0)"), (12, "__atomic_fetch_max((uchar *){}, (uchar)({}), 0)"),
    (13, "__atomic_fetch_min((short *){}, (short)({}), 0)"), (14, "__atomic_fetch_and((uchar *){} + 2, (uchar)({}), 0)"),
]
# On a word of the lane's own the result may be used.
OWN = ["add", "sub", "and", "or", "xor", "nand", "min", "max"]


class Statements(Expressions):
    """Statements of one function. `in_phase`: of a kernel, with a state and shared words; else of a helper."""

    def __init__(self, random, scope, in_phase):
        super().__init__(random, scope)
        self.in_phase = in_phase
        self.names = 0
        self.leave = ["goto end;"]
        # Most functions are small, so that there can be many; some are deeply nested.
        self.deepest = random.choice([1, 1, 1, 1, 2, 2, 2, 3, 4])

    def fresh(self, prefix):
        self.names += 1
        return f"{prefix}{self.names}"

    # --- straight ---------------------------------------------------------

    def simple(self):
        scope = self.scope
        makers = [(50, self.change),
                  (15, lambda: f"{self.pick(scope.floats)} = {self.floating()};"),
                  (8, lambda: f"{self.pick(scope.longs)} = {self.long()};"),
                  (8, lambda: f"{self.pick(scope.words).format(f'({self.integer(2)}) & 3')} = {self.integer(1)};"),
                  (2, self.volatile_access)]
        if self.in_phase:
            makers += [(2, lambda: f"{self.pick(scope.doubles)} = {self.double()};"), (3, self.structure),
                       (9, self.shared_atomic), (5, self.own_atomic), (4, lambda: f"m->mine[LANE] = {self.integer(1)};")]
        weights, functions = zip(*makers)
        return self.random.choices(functions, weights)[0]()

    def change(self):
        """Of an integer. Mostly something of the old value stays, or all would soon be the same in all lanes."""
        to = self.pick(self.scope.ints)
        return f"{to} {self.pick(['=', '+=', '+=', '^=', '^=', '-='])} {self.integer()};"

    def volatile_access(self):
        if not self.in_phase:
            return f"vol ^= {self.integer(1)};"
        place = self.pick(["((volatile uchar *)s->b)[({}) & 7]", "((volatile ushort *)s->h)[({}) & 3]",
                           "((volatile uint *)own)[({}) & 3]", "((volatile signed char *)own)[16 + (({}) & 7)]"])
        index = self.integer(2)
        if self.chance(0.5):
            return f"{place.format(index)} = {self.integer(1)};"
        return f"{self.pick(self.scope.ints)} += (uint){place.format(index)};"

    def structure(self):
        if self.chance(0.4):
            return f"s->p.first = {self.integer()};"
        if not self.pay(40):
            return f"s->p.second = {self.floating()};"
        return (f"s->p = turn({self.pick(['s->p', f'(pair){{{self.integer(1)}, {self.floating(1)}}}'])}, "
                f"(uint4){{{', '.join(self.integer(2) for _ in range(4))}}});")

    def shared_atomic(self):
        index, template = self.pick(COMMUTING)
        if not self.pay(60):  # compare-exchange loops take a turn a lane
            return ";"
        words = self.pick(["(m->mine + 16)", "(m->mine + 16)", "m->shared"])
        return template.format(f"({words} + {index})", self.integer(1)) + ";"

    def own_atomic(self):
        if not self.pay(20):
            return ";"
        kind = self.pick(["uint", "uint", "ushort", "uchar"])
        word = "own + 7" if kind == "uint" else f"({kind} *)own + {self.random.randint(5, 6)}"
        if self.chance(0.2):
            return (f"{{ {kind} was = ({kind})({self.integer(2)}); {self.pick(self.scope.ints)} += "
                    f"(uint)__atomic_compare_exchange_n({word}, &was, ({kind})({self.integer(2)}), 0, 0, 0) + was; }}")
        if self.chance(0.2):
            return f"{self.pick(self.scope.ints)} = __atomic_exchange_n({word}, ({kind})({self.integer(2)}), 0);"
        return f"{self.pick(self.scope.ints)} = __atomic_fetch_{self.pick(OWN)}({word}, ({kind})({self.integer(2)}), 0);"

    # --- control flow -----------------------------------------------------

    def block(self, depth, loop="", longest=3):
        """`loop` says what may leave or repeat it: break, continue."""
        return " ".join(self.statement(depth, loop) for _ in range(self.random.choice([1, 1, 2, longest])))

    def repeated(self, times, make):
        """What `make` returns, as code that runs so many times."""
        self.weight *= times
        try:
            return make()
        finally:
            self.weight //= times

    def statement(self, depth, loop):
        makers = [(40, self.simple)]
        if depth < self.deepest:
            makers += [(24, lambda: self.branch(depth, loop)), (8, lambda: self.switch(depth, loop))]
            makers += [(2, self.dead_end)]
            if self.weight <= 200:
                makers += [(12, lambda: self.loop(depth)), (2, lambda: self.entered_twice(depth)),
                           (2, lambda: self.entered_by_switch(depth)), (2, lambda: self.blocks(depth))]
        if loop:
            makers += [(10, lambda: f"if ({self.top_condition()}) {self.pick(loop.split())};")]
        makers += [(3, lambda: f"if ((({self.integer(2)} + t) & 7u) == {self.random.randrange(8)}u) {self.pick(self.leave)}")]
        weights, functions = zip(*makers)
        return self.random.choices(functions, weights)[0]()

    def dead_end(self):
        """Where no lane goes, which the compiler does not know: loops without end and what follows a trap."""
        to, i = self.pick(self.scope.ints), self.fresh("i")
        never = self.pick(["impossible", f"(impossible & {self.integer(2)})"])
        return self.pick([
            f"if ({never}) for (;;) ;",
            f"if ({never}) while (1) {to} = {self.integer(1)};",
            f"while ({never}) {to} ^= 1u;",
            f"for (uint {i} = 1u << 31; {i} != 0; {i} += {never} ? 0u : 1u << 31) {to}++;",
            f"if ({never}) __builtin_trap();",
            f"if ({never}) stay();"])

    def top_condition(self):
        """A condition of a statement may have effects, in the order that && and || say."""
        if self.chance(0.12):
            change = f"({self.pick(self.scope.ints)} = {self.integer(1)}, {self.condition(1)})"
            return f"{self.condition(1)} {self.pick(['&&', '||'])} {change}"
        return self.condition()

    def branch(self, depth, loop):
        text = f"if ({self.top_condition()}) {{ {self.block(depth + 1, loop)} }}"
        while self.chance(0.2):
            text += f" else if ({self.condition()}) {{ {self.block(depth + 1, loop, 2)} }}"
        return text + (f" else {{ {self.block(depth + 1, loop)} }}" if self.chance(0.5) else "")

    def switch(self, depth, loop):
        many = self.chance(0.3)  # dense enough for a jump table
        values = self.random.sample(range(16 if many else 8), 7 if many else 3)
        inside = loop if "continue" not in loop else "continue"  # break leaves the switch
        inside = (inside + " break").strip()
        cases = [f"case {value}: {self.block(depth + 1, inside, 2)} {self.pick(['break;', 'break;', ''])}"
                 for value in values]
        cases.insert(self.random.randint(0, len(cases)), f"default: {self.block(depth + 1, inside, 2)} {self.pick(['break;', ''])}")
        return f"switch (({self.integer(1)} + t) & {15 if many else 7}u) {{ {' '.join(cases)} ; }}"

    def loop(self, depth):
        i = self.fresh("i")
        bound = self.pick([f"({self.integer(1)} & 7u)", f"({self.integer(1)} & 3u)", f"({self.pick(self.scope.uniform)} & 3u)", "3u"])
        body = self.repeated(5, lambda: self.block(depth + 1, "break continue"))
        return self.pick([
            f"for (uint {i} = 0; {i} < {bound}; {i}++) {{ {body} }}",
            f"for (uint {i} = {bound}; {i} != 0; {i}--) {{ {body} }}",
            f"for (uint {i} = 0; {i} < 6 && {self.condition(1)}; {i} += 1 + ({self.integer(2)} & 1)) {{ {body} }}",
            f"{{ uint {i} = 0; do {{ {body} }} while (++{i} < 5 && {self.condition()}); }}",
            f"{{ uint {i} = 0; while (1) {{ if (++{i} > {bound}) break; {body} }} }}",
            f"{{ uint {i} = 9; while (({i} >>= 1) || ({self.condition(2)} && {i}++ == 0 && ({i} = 7) == 8)) {{ {body} }} }}"])

    def entered_twice(self, depth):
        """A loop that is entered in two places."""
        k = self.fresh("k")

        def body():
            return (f"top{k}: {self.block(depth + 1, longest=2)} middle{k}: {self.block(depth + 1, longest=2)} "
                    f"if (++{k} < 4 && {self.condition()}) goto top{k};")
        return f"{{ uint {k} = 0; if ({self.condition()}) goto middle{k}; {self.repeated(4, body)} }}"

    def entered_by_switch(self, depth):
        """A loop in a switch, some of whose cases are inside the loop."""
        k = self.fresh("k")

        def body():
            # A break there would leave the loop, and a continue ask its condition: both are allowed.
            parts = [self.block(depth + 1, "break continue", 2) for _ in range(3)]
            return (f"case 0: do {{ {parts[0]} case 1: {parts[1]} case 3: {parts[2]} }} while (++{k} < 4 && {self.condition()});")
        return f"{{ uint {k} = 0; switch (({self.integer(1)} + t) & 3u) {{ {self.repeated(4, body)} }} }}"

    def blocks(self, depth):
        """Blocks that jump to each other however they like, a limited number of times."""
        k, count = self.fresh("k"), self.random.randint(3, 6)

        def to():
            return f"goto {k}_{self.random.randrange(count)};"

        def ending():
            kind = self.random.random()
            if kind < 0.3:
                return f"if ({self.condition()}) {to()} else {to()}"
            if kind < 0.5:
                return f"if ({self.condition()}) {to()}"
            if kind < 0.7:
                return f"switch (({self.integer(1)} + t) & 3u) {{ case 0: {to()} case 1: {to()} case 2: {to()} default: ; }}"
            return to()

        def body():
            return " ".join(f"{k}_{n}: if (++{k} > 12) goto {k}_end; {self.block(depth + 2, longest=2)} {ending()}"
                            for n in range(count))
        return f"{{ uint {k} = 0; goto {k}_0; {self.repeated(6, body)} {k}_end:; }}"
