"""Random OpenCL kernels with barriers, as text that group_host.h makes C of.

Private variables x y z f w a[] differ between work-items; u v and loop counters are the same in all of a group, and alone
decide about code with barriers. Between two barriers nobody reads what another work-item writes.
"""

import random

import local_memory

GROUPS = 3
SIZES = [1, 7, 16, 17, 20, 64]
IN_WORDS = 64
ITEM_WORDS = 8  # of the output for a work-item
LOCAL_WORDS = 4  # of the local memory that is an argument, for a work-item: one of `t`, three of the structures behind it

PROLOGUE = """
#ifndef GROUPS_ON_HOST
#define LOCAL_ARRAY local
#define LOCAL_POINTER(name) local uint *local name
#define REQUIRED_SIZE(n) __attribute__((reqd_work_group_size(n, 1, 1)))
/* Words of local memory as components of vectors, of which other work-items write the others. */
static void put_by_switch(local uint *t, uint i, uint value) {
  local uint4 *to = (local uint4 *)t + i / 4;
  switch (i & 3) {
  case 0: to->x = value; break;
  case 1: to->y = value; break;
  case 2: to->z = value; break;
  default: to->w = value;
  }
}
static void put_by_if(local uint *t, uint i, uint value) {
  local uint2 *to = (local uint2 *)t;
  if (i & 1) to[i / 2].y = value;
  else to[i / 2].x = value;
}
static void put_at(local uint *t, uint i, uint value) { ((local uint4 *)t)[i / 4][i & 3] = value; }
#endif
static int is_odd(uint x) { if (x & 1u) return 1; return x == 6u; }
static uint bits_of(float f) { return f != f ? 0x7fc00000 : as_uint(f); }
/* A barrier in a function: who calls it does not see one. */
static uint pass_on(local uint *t, uint value, uint by) {
  uint l = get_local_id(0), n = get_local_size(0);
  t[l] = value;
  barrier(CLK_LOCAL_MEM_FENCE);
  uint got = t[(l + by) % n];
  barrier(CLK_LOCAL_MEM_FENCE);
  return got;
}
""" + local_memory.PROLOGUE + """
/* The input has no such word and k is small, which the compiler does not know: no work-item comes to a dead end. */
#define NEVER 0xfeedf00du
static uint stuck(uint word) {
  if (word == NEVER) for (;;) ;
  return word;
}
"""

# What kernels may have beside the usual, and the help of the option of that name.
FORMS = {
    "jumps": "break, continue and goto on which the group agrees, within conditionals on which it does not",
    "returns": "work-items that return before barriers to which others of their group come",
    "components": "words of local memory that work-items write as components of vectors",
    "continues": "single work-items that go on to a loop's next round behind its last barrier",
}


class Kernel:
    """One kernel; `required` is a group size it is compiled for, or None, `forms` what it may have beside the usual (FORMS)."""

    def __init__(self, rand, name, required, forms):
        self.random = rand
        self.name = name
        self.required = required
        self.forms = forms
        # Whether arguments and ids alone decide about code with barriers, nothing from memory.
        self.plain = "returns" in forms and self.chance(0.6)
        self.names = 0
        self.weight = 1
        self.counters = []
        self.memory = local_memory.LocalMemory(self)
        self.deepest = rand.choice([1, 2, 2, 3])

    def pick(self, choices):
        return self.random.choice(choices)

    def chance(self, probability):
        return self.random.random() < probability

    def fresh(self, prefix):
        self.names += 1
        return f"{prefix}{self.names}"

    # --- expressions ------------------------------------------------------

    def value(self, depth=0):
        """Of a work-item's own."""
        if depth > 2 or self.chance(0.35):
            return self.pick(["x", "y", "z", "x", "y", "z", "l", "a[l & 3]", "(uint)(w >> 20)", "bits_of(f)", self.uniform(2),
                              f"{self.random.randint(1, 99)}u"])
        a, b = self.value(depth + 1), self.value(depth + 1)
        return self.pick([f"({a} {self.pick('+-*^&|')} {b})", f"({a} {self.pick('+-*^&|')} {b})",
                          f"({self.condition(depth + 1)} ? {a} : {b})", f"in[({a}) % {IN_WORDS}u]", f"({a} >> ({b} & 31u))",
                          f"({a} % ({b} | 1u))"])

    def uniform(self, depth=0):
        """The same in all work-items of a group."""
        if depth > 1 or self.chance(0.4):
            known = ["k", "(uint)get_group_id(0)", "n", f"{self.random.randint(1, 9)}u", *self.counters]
            return self.pick(known if self.plain else ["u", "v", *known])
        a, b = self.uniform(depth + 1), self.uniform(depth + 1)
        if self.plain:
            return f"({a} {self.pick(['+', '-', '*', '^', '>>'])} ({b} & 15u))"
        return self.pick([f"({a} {self.pick('+-*^')} {b})", f"in[({a}) % {IN_WORDS}u]", f"({a} >> ({b} & 3u))"])

    def condition(self, depth=0):
        mask = self.pick([1, 1, 2, 3])
        test = f"(({self.value(depth + 1)} & {mask}u) {self.pick(['==', '!='])} {self.random.randint(0, mask)}u)"
        return test if self.chance(0.7) else f"({test} {self.pick(['&&', '||'])} {self.pick(['l', 'x'])} {self.pick('<>')} {self.uniform(1)})"

    def agreed(self):
        """A condition that all work-items of a group answer alike."""
        return f"(({self.uniform()}) & {self.pick([1, 1, 2, 3])}u)"

    # --- code without barriers --------------------------------------------

    def own(self, depth=0, loop=False):
        if "returns" in self.forms and self.chance(0.1):
            return self.leave()
        kind = self.random.random()
        if kind < 0.5 or depth >= self.deepest:
            return self.pick([f"{self.pick('xyz')} = {self.value()};", f"{self.pick('xyz')} += {self.value()};",
                              f"a[({self.value(2)}) & 3] = {self.value(1)};", f"w = w * 5 + {self.value(1)};",
                              f"f = f * 0.5f + (float)(int)({self.value(2)});"])
        if kind < 0.53:
            return self.dead_end()
        body = self.own_block(depth + 1, loop)
        if kind < 0.7:
            return f"if ({self.condition()}) {{ {body} }}" + (f" else {{ {self.own_block(depth + 1, loop)} }}" if self.chance(0.5) else "")
        if kind < 0.78:
            return (f"switch ({self.value(1)} & 3u) {{ case 0: {body} break; case 2: {self.own_block(depth + 1, False)} "
                    f"default: {self.own_block(depth + 1, False)} }}")
        if kind < 0.86 and loop:
            return f"if ({self.condition()}) {self.pick(['break;', 'continue;'])}"
        i = self.fresh("i")
        return f"for (uint {i} = 0; {i} < (({self.value(1)}) & 3u); {i}++) {{ {self.own_block(depth + 1, True)} }}"

    def leave(self):
        """Some work-items return, perhaps all or none."""
        some = self.pick([self.condition(), f"l >= ({self.uniform(1)})", f"l < ({self.uniform(1)})", f"is_odd({self.value(1)})",
                          f"l == ({self.uniform(1)}) % n", "get_global_id(0) >= k", "k > 1000u", f"({self.uniform(1)}) % 5u == 1u"])
        return self.pick([f"if ({some}) return;", f"if ({some}) return;", f"if ({some}) {{ mine[{self.random.randint(0, 7)}] = {self.value(1)}; return; }}",
                          f"if ({some}) {{ {self.pick('xyz')} = {self.value(1)}; if ({self.condition()}) return; }}"])

    def dead_end(self):
        """Where no work-item goes: loops without end and what follows a trap."""
        never, j = self.pick(["k > 1000u", f"in[({self.value(2)}) % {IN_WORDS}u] == NEVER"]), self.fresh("j")
        return self.pick([
            f"if ({never}) for (;;) ;",
            f"if ({never}) while (1) {{ out[l] = x++; }}",
            f"while ({never}) x ^= 1u;",
            f"{self.pick('xyz')} += stuck(in[({self.value(2)}) % {IN_WORDS}u]);",
            f"for (uint {j} = 1u << 31; {j} != 0; {j} += {never} ? 0u : 1u << 31) y++;",
            f"if ({never}) __builtin_trap();"])

    def own_block(self, depth, loop):
        return " ".join(self.own(depth, loop) for _ in range(self.random.randint(1, 3)))

    # --- code with barriers -----------------------------------------------

    def put(self, value):
        """Into the work-item's word of `t`."""
        if "components" not in self.forms:
            return f"t[l] = {value};"
        return self.pick([f"t[l] = {value};", f"put_by_switch(t, l, {value});", f"put_by_if(t, l, {value});",
                          f"put_at(t, l, {value});"])

    def meeting(self):
        """Work-items tell each other something."""
        to, by = self.pick("xyz"), self.pick(["1u", "n - 1u", "l", self.uniform(1)])
        kind = self.random.random()
        if kind < 0.3:
            return (f"{self.put(self.value())} barrier(CLK_LOCAL_MEM_FENCE); {to} ^= t[(l + {by}) % n];\n"
                    "  barrier(CLK_LOCAL_MEM_FENCE);")
        if kind < 0.4:
            return (f"{self.put(self.value())} barrier(CLK_LOCAL_MEM_FENCE); {self.pick('uv')} = t[{self.pick(['0', 'n - 1', 'n / 2'])}];\n"
                    "  barrier(CLK_LOCAL_MEM_FENCE);")
        if kind < 0.55:
            return f"{to} += pass_on(t, {self.value()}, {self.uniform(1)});"
        if kind < 0.7:
            return (f"shared[l] = {self.value(1)}; barrier(CLK_GLOBAL_MEM_FENCE); {to} += shared[(l * 3 + {by}) % n];\n"
                    "  barrier(CLK_GLOBAL_MEM_FENCE);")
        if kind < 0.85:
            operation = self.pick(["add", "max", "xor"])
            update = f"atomic_{operation}(&counter, {self.value(1)});"
            if self.chance(0.5):
                update = f"if ({self.condition()}) {update}"
            return (f"if (l == 0) counter = 0; barrier(CLK_LOCAL_MEM_FENCE); {update} barrier(CLK_LOCAL_MEM_FENCE);\n"
                    f"  {self.pick([to, 'v'])} = counter; barrier(CLK_LOCAL_MEM_FENCE);")
        # Other items' results of their own loops, through static local memory.
        return (f"kept[l % 16][0] = 0; barrier(CLK_LOCAL_MEM_FENCE); if (l < 16) kept[l][0] = {self.value(1)}; "
                f"barrier(CLK_LOCAL_MEM_FENCE); {to} += kept[({self.value(2)}) % (n < 16 ? n : 16u)][0] + kept[l % 16][0];\n  barrier(CLK_LOCAL_MEM_FENCE);")

    def parted_jump(self, loop):
        """A conditional at which work-items part, with a jump that all of a group take or none, on each side or, for none, on one."""
        jump = self.pick(["break;", "continue;", "goto done;"]) if loop else "goto done;"

        def side(condition):
            return f"{{ {self.own_block(1, False)} if ({condition}) {jump} {self.own_block(1, False) if self.chance(0.6) else ''} }}"
        if self.chance(0.3):
            return f"if ({self.condition()}) {side('k > 1000u')}"
        all_or_none, agreed = self.fresh("all"), self.agreed()
        sides = [side(all_or_none), side(all_or_none)]
        if self.chance(0.3):
            sides[self.random.randint(0, 1)] = f"if ({self.condition()}) {side(all_or_none)} else {side(all_or_none)}"
        return f"{{ uint {all_or_none} = {agreed};\n  if ({self.condition()}) {sides[0]}\n  else {sides[1]} }}"

    def retry(self):
        """A loop with barriers that begins with one that work-items go round apart; LLVM gives both one head."""
        i, bound = self.fresh("i"), self.pick(["3u", "(k & 3u)", "2u"])
        return (f"{{ uint {i} = 0; do {{ do {{ x = x * 1664525u + 1013904223u; w++; }} while (x >> 29 != 5u);\n"
                f"  {self.meeting()} }} while (++{i} < {bound}); }}")

    def together(self, depth, loop=False):
        """A statement that all work-items of a group come to."""
        if "jumps" in self.forms and self.chance(0.15):
            return self.retry() if self.chance(0.2) else self.parted_jump(loop)
        kind = self.random.random()
        if kind < 0.34:
            return self.own()
        if kind < 0.62 or depth > 2:
            return self.memory.statement() if self.chance(0.5) else self.meeting()
        if kind < 0.66:
            return f"{self.pick('uv')} = {self.uniform()};"
        if kind < 0.8:
            other = f" else {{\n  {self.together_block(depth + 1, loop)} }}" if self.chance(0.4) else ""
            return f"if ({self.agreed()}) {{\n  {self.together_block(depth + 1, loop)} }}{other}"
        if kind < 0.84 and loop:
            return f"if ({self.agreed()}) {self.pick(['break;', 'continue;'])}"
        if kind < 0.86:
            return f"if (({self.uniform()}) % 7u == 3u) goto done;"
        if self.weight >= 12:
            return self.own()
        return self.loop(depth)

    def end_of_round(self, counter):
        """Behind a round's last barrier: single work-items go on to the next round, or do something more."""
        more, leave = self.own_block(1, False), self.pick([self.agreed(), f"{counter} & 1u"])
        return (f"if ({leave}) break; " if self.chance(0.6) else "") + self.pick([
            f"if ({self.condition()}) continue; {more}",
            f"if ({self.condition()}) {{ {more} }}",
            f"if ({self.condition()}) {{ {more} if ({self.condition()}) continue; }} {self.own_block(1, False)}"])

    def loop(self, depth):
        i, bound = self.fresh("i"), self.pick([f"(({self.uniform(1)}) & 3u)", "3u", "(k & 3u)", "2u"])
        self.weight *= 3
        self.counters.append(i)
        body = self.together_block(depth + 1, True)
        if "continues" in self.forms and self.chance(0.6):
            body += "\n  " + self.end_of_round(i)
        if {"continues", "returns"} <= set(self.forms) and self.chance(0.3):
            # All return long before the loop ends.
            bound = "(1u << 30)"
            body = f"if ({i} > (({self.value(1)}) & 3u)) return;\n  {body}"
        self.counters.pop()
        self.weight //= 3
        return self.pick([
            f"for (uint {i} = 0; {i} < {bound}; {i}++) {{\n  {body} }}",
            f"for (uint {i} = {bound}; {i} > 0; {i}--) {{\n  {body} }}",
            f"{{ uint {i} = 0; do {{\n  {body} }} while (++{i} < {bound}); }}",
            f"{{ uint {i} = 0; while (1) {{ if ({i}++ >= {bound}) break;\n  {body} }} }}"])

    def together_block(self, depth, loop):
        return "\n  ".join(self.together(depth, loop) for _ in range(self.random.randint(1, 3)))

    def source(self):
        declarations = self.memory.declarations()
        # Who returns leaves what he would have set as it is.
        start = self.memory.cleared() if "returns" in self.forms else ""
        start += self.memory.start()
        statements = [self.together(0) for _ in range(self.random.randint(2, 5))]
        statements.insert(self.random.randint(0, len(statements)), self.memory.statement())
        body = "\n  ".join(statements)
        attribute = f"REQUIRED_SIZE({self.required}) " if self.required else ""
        return (f"{attribute}kernel void {self.name}(global uint *out, global const uint *in, local uint *t, uint k) {{\n"
                f"  LOCAL_ARRAY uint counter, kept[16][3];\n{declarations}"
                "  uint l = get_local_id(0), n = get_local_size(0), x = l * 7 + k, y = l ^ 5, z = get_group_id(0), u = k, v = 3;\n"
                f"  uint a[4] = {{1, l, n, 4}};\n  ulong w = l;\n  float f = 0.5f;\n"
                f"  global uint *mine = out + (get_group_id(0) * n + l) * {ITEM_WORDS};\n"
                f"  global uint *shared = out + {GROUPS * ITEM_WORDS} * n + get_group_id(0) * n;\n"
                f"{start}  {body}\n"
                " done:\n  mine[0] = x; mine[1] = y; mine[2] = z; mine[3] = u ^ v << 16; mine[4] = bits_of(f);\n"
                "  mine[5] = (uint)w ^ (uint)(w >> 32); mine[6] = a[0] ^ a[1] << 8; mine[7] = a[2] ^ a[3] << 8;\n}\n")


class Program:
    """Kernels for any group size, and the same with the sizes that they are compiled for."""

    def __init__(self, seed, kernels, forms):
        self.random = random.Random(seed)
        self.argument = self.random.randint(0, 40)
        self.input = [self.random.getrandbits(32) >> self.random.choice([0, 0, 28]) for _ in range(IN_WORDS)]
        required = [None] * (kernels - 2) + [7, 16]
        self.forms = forms
        self.kernels = [Kernel(self.random, f"k{number}", size, forms) for number, size in enumerate(required)]
        self.text = PROLOGUE + "".join(kernel.source() for kernel in self.kernels)

    def runs(self):
        """(kernel's name, group size)."""
        return [(kernel.name, size) for kernel in self.kernels for size in ([kernel.required] if kernel.required else SIZES)]

    @staticmethod
    def out_words(size):
        return GROUPS * size * (ITEM_WORDS + 1)

    def host_source(self):
        calls = "".join(f"  run_kernel({name}, {size}, {GROUPS}, {self.out_words(size)}, in, {self.argument});\n"
                        for name, size in self.runs())
        may_return = int("returns" in self.forms)
        return (f"#define GROUPS_ON_HOST\n#define LOCAL_WORDS {LOCAL_WORDS}\n#define MAY_RETURN {may_return}\n#include \"group_host.h\"\n{self.text}\nint main(void) {{\n"
                f"  static const uint in[] = {{{', '.join(f'{word}u' for word in self.input)}}};\n{calls}  return fclose(stdout);\n}}\n")
