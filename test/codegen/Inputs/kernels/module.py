"""A module of random kernels as C source (kernels.h says how it runs)."""

import random

from expressions import Helper, Scope
from statements import Statements

# As in kernels.h.
OUT_WORDS = 32
SHARED_WORDS = 16
HALF_WORDS = 32
SHARED_START = 0x7f3c0ff1
GROUPS = 2


class Module:
    """All is decided by the seed."""

    def __init__(self, seed, kernels, lanes=None):
        self.random = random.Random(seed)
        self.kernels = kernels
        by_chance = self.random.choice([16, 16, 16, 7, 2, 1])
        self.lanes = lanes or by_chance
        self.argument = self.random.randint(0, 40)
        self.helpers = []

    def out_bytes(self):
        """A kernel's share of the buffer that is compared, in bytes."""
        return 4 * (GROUPS * self.lanes * OUT_WORDS + SHARED_WORDS)

    def out_start(self):
        """What the buffer holds before: the shared words do not start at 0, which `and` and products would keep."""
        lanes = bytes(4 * GROUPS * self.lanes * OUT_WORDS)
        return (lanes + SHARED_START.to_bytes(4, "little") * SHARED_WORDS) * self.kernels

    def qualifier(self):
        return self.random.choice(["NOINLINE", "NOINLINE", "INLINE", "PLAIN"])

    def helper(self, number):
        """A function of random control flow that may call those before it."""
        name = f"helper{number}"
        scope = Scope(ints=["x", "y", "z"], uniform=["x", "0x35u"], longs=["w"], floats=["f", "g"], doubles=["1.0"],
                      words=["local[{}]"], helpers=list(self.helpers))
        body = Statements(self.random, scope, in_phase=False)
        body.MAX_COST = 1500
        body.leave = ["goto end;", "return x ^ z;", f"return {self.random.randint(0, 99)};"]
        text = body.block(1, longest=5)
        self.helpers.append(Helper(name, 100 + body.cost))
        return (f"{self.qualifier()} UNUSED uint {name}(uint x, uint y, float f) {{\n"
                "  uint z = x + 1, t = LANE, local[4] = {x, y, 3, t}; ulong w = y; float g = 0.5f; volatile uint vol = x;\n"
                f"  {text}\n  goto end;\n end:\n  return x + y * 3 + z * 5 + bits(f) + bits(g) + local[x & 3] + (uint)(w >> 16) + vol;\n}}\n")

    def phase(self, name):
        """A function that a lane runs between two barriers."""
        scope = Scope(ints=["x", "y", "z", "u", "v", "r"], uniform=["m->n", "m->group", "u", "v"], longs=["w"],
                      floats=["f", "g"], doubles=["d"], words=["s->a[{}]", "s->h[{}]", "s->b[{}]", "local[{}]"],
                      readable=["m->theirs[({}) % m->lanes]", "m->theirs[16 + ({})]", "m->theirs[20 + ({})]",
                                "m->theirs[24 + ({})]"], helpers=self.helpers)
        body = Statements(self.random, scope, in_phase=True)
        leave = ["goto end;", "goto almost;", "{ s->x = x + 3 * y + 7 * z; return; }"]
        body.leave = leave
        first = body.block(0)
        body.leave = [leave[0], leave[2]]  # forward only, or programs might not end
        second = body.block(0, longest=3)
        return (f"{self.qualifier()} UNUSED void {name}(state *s, const group *m) {{\n"
                "  uint x = s->x, y = s->y, z = s->z, t = LANE, u = s->u, v = s->v, r = s->r;\n"
                "  float f = s->f, g = s->g; ulong w = s->w; double d = s->d;\n"
                "  uint local[4] = {1, t, m->n, 4}, *own = m->out + (m->group * m->lanes + LANE) * OUT_WORDS;\n"
                f"  {first}\n  goto almost;\n almost:\n  {second}\n  goto end;\n"
                " end:\n  s->x = x; s->y = y; s->z = z; s->u = u; s->v = v; s->r = r + local[0] + local[1] + local[2] + local[3];\n"
                "  s->f = f; s->g = g; s->w = w; s->d = d;\n}\n")

    def lanes_together(self):
        """What all lanes of a warp do at once."""
        value = self.random.choice(["S.x", "S.y & 1", "S.z > 9", "(uint)(S.f < S.g)"])
        kind = self.random.choice(["BALLOT", "ANY", "ALL", "EXCHANGE"])
        last = f", {self.random.choice([1, 2, 3, 8])}" if kind == "EXCHANGE" else ""
        return f"{kind}({self.random.choice(['S.r', 'S.u', 'S.v'])}, {value}{last});"

    def kernel(self, number):
        """Phases between barriers, in uniform control flow; always two, so that `mine` and `theirs` come out even."""
        functions = []

        def pair():
            text = ""
            for _ in range(2):
                name = f"kernel{number}_phase{len(functions)}"
                functions.append(self.phase(name))
                together = self.lanes_together() if self.random.random() < 0.25 else ""
                text += f"  EACH_LANE {name}(&S, &m);\n  BARRIER;\n  SWAP_HALVES; {together}\n"
            return text

        body = pair()
        kind = self.random.random()
        if kind < 0.15:
            body += f"  for (uint i = 0; i < (m.n & 3); i++) {{\n{pair()}  }}\n"
        elif kind < 0.25:
            body += f"  if ((m.n ^ m.group) & 1) {{\n{pair()}  }}\n"
        return "".join(functions) + (
            f"{self.qualifier()} void kernel{number}(uint *out, uint *local, uint n, uint lanes, uint number) {{\n"
            f"  group m = {{out, out + {GROUPS} * lanes * OUT_WORDS, local, local + HALF_WORDS, n, lanes, number}};\n  STATES;\n"
            f"  EACH_LANE begin_lane(&S, &m);\n  BARRIER;\n{body}  EACH_LANE end_lane(&S, &m);\n  BARRIER;\n}}\n")

    def source(self):
        """The whole module; with -DONLY=n kernel n alone runs."""
        parts = ['#include "kernels.h"\n',
                 "#define SWAP_HALVES do { uint *old = m.mine; m.mine = m.theirs; m.theirs = old; } while (0)\n"]
        for number in range(self.kernels):
            if number % 4 == 0:
                self.helpers = self.helpers[-2:]
                parts.append(self.helper(number))
            parts.append(f"#if !defined(ONLY) || ONLY == {number}\n{self.kernel(number)}#endif\n")
        share = self.out_bytes() // 4
        calls = "".join(f"#if !defined(ONLY) || ONLY == {n}\n  kernel{n}(out + {n * share}, local, n, lanes, number);\n#endif\n"
                        for n in range(self.kernels))
        parts.append(f"static void run_kernels(uint *out, uint *local, uint n, uint lanes, uint number) {{\n{calls}}}\n"
                     f"enum {{ KERNELS = {self.kernels}, KERNEL_WORDS = {share}, LANES = {self.lanes}, GROUPS = {GROUPS}, "
                     f"ARGUMENT = {self.argument} }};\n#include \"entry.h\"\n")
        return "".join(parts)
