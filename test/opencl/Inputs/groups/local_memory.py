"""A random kernel's local memory in all the forms in which OpenCL C has it, and what work-items do with it.

Every statement here is one that all work-items of a group come to. It leaves with a barrier, so that what it read may be
written again. Between two barriers a variable is written by one work-item, by all with one value, or by each at a place of
its own. Some variables are set at the kernel's start and keep their value for as long as they like; others hold nothing
when a statement begins; some are never read, or never touched at all.
"""

PROLOGUE = """
typedef struct { uint a; ushort b[2]; float c; } part;
static void set(local uint *p, uint value) { *p = value; }
__attribute__((noinline)) static void add_to(local uint *p, uint place, uint value) { p[place] += value; }
__attribute__((noinline)) static uint sum_of(local const uint *p, uint count) {
  uint sum = 0;
  for (uint i = 0; i < count; i++) sum = sum * 3u + p[i];
  return sum;
}
static part turned(local const part *p, uint by) {
  part own = *p;
  own.a += by; own.b[1] = (ushort)(own.b[0] ^ by); own.c = own.c * 0.5f + 1.0f;
  return own;
}
/* A variable of the caller's, first the same from all, then of one. */
static uint told_by(local uint *p, uint who, uint value) {
  *p = 9u;
  barrier(CLK_LOCAL_MEM_FENCE);
  if (get_local_id(0) == who) *p = value;
  barrier(CLK_LOCAL_MEM_FENCE);
  uint got = *p;
  barrier(CLK_LOCAL_MEM_FENCE);
  return got;
}
"""

BARRIER = "barrier(CLK_LOCAL_MEM_FENCE);"
SCALARS = ["uint", "uint", "uint", "int", "ushort", "uchar", "ulong", "volatile uint"]


class LocalMemory:
    """Of one kernel, whose `value`, `uniform`, `condition`, `pick` and `chance` it uses."""

    def __init__(self, kernel):
        self.kernel = kernel
        pick, chance = kernel.pick, kernel.chance
        self.scalars = [(f"s{i}", pick(SCALARS)) for i in range(kernel.random.randint(1, 4))]
        self.words = [name for name, kind in self.scalars if kind == "uint"]
        self.arrays = [(f"r{i}", pick([1, 1, 2, 3, 4, 8, 16])) for i in range(kernel.random.randint(1, 3))]
        self.parts = [f"p{i}" for i in range(kernel.random.randint(0, 2))]
        self.rows = chance(0.4)      # an array of arrays, a row an item
        self.bytes = chance(0.4)     # a byte an item
        self.pointer = chance(0.3)   # a pointer to local memory in local memory
        self.vector = chance(0.3)
        self.kept = [name for name, _ in self.scalars if chance(0.6)]
        self.kept_arrays = [(name, size) for name, size in self.arrays if chance(0.5)]

    def declarations(self):
        lines = [f"LOCAL_ARRAY {kind} {name};" for name, kind in self.scalars]
        lines += [f"LOCAL_ARRAY uint {name}[{size}];" for name, size in self.arrays]
        lines += [f"LOCAL_ARRAY part {name}[2];" for name in self.parts]
        lines += ["LOCAL_ARRAY uint rows[64][3];"] * self.rows + ["LOCAL_ARRAY uchar bytes[64];"] * self.bytes
        lines += ["LOCAL_ARRAY uint4 quad;"] * self.vector
        lines += ["LOCAL_POINTER(place);"] * self.pointer
        if self.kernel.chance(0.3):
            lines.append("LOCAL_ARRAY uint unused, unread[2];")
        self.kernel.random.shuffle(lines)
        return "".join(f"  {line}\n" for line in lines)

    def cleared(self):
        """Sets everything."""
        lines = [f"{name} = 0;" for name, _ in self.scalars]
        lines += [f"for (uint j = 0; j < {size}; j++) {name}[j] = 0;" for name, size in self.arrays]
        lines += [f"for (uint j = 0; j < 2; j++) {{ {name}[j].a = 0; {name}[j].b[0] = {name}[j].b[1] = 0; {name}[j].c = 0; }}" for name in self.parts]
        lines += ["for (uint j = 0; j < 64 * 3; j++) rows[j / 3][j % 3] = 0;"] * self.rows
        lines += ["for (uint j = 0; j < 64; j++) bytes[j] = 0;"] * self.bytes
        lines += ["quad = (uint4)(0);"] * self.vector + [f"place = {self.arrays[0][0]};"] * self.pointer
        lines += ["counter = 0;", "for (uint j = 0; j < 16 * 3; j++) kept[j / 3][j % 3] = 0;", "for (uint j = 0; j < 4 * n; j++) t[j] = 0;"]
        return "  if (l == 0) {\n    " + "\n    ".join(lines) + f"\n  }}\n  {BARRIER}\n"

    def start(self):
        """Sets what is kept."""
        if not self.kept and not self.kept_arrays:
            return ""
        lines = [self.first(name) for name in self.kept]
        for name, size in self.kept_arrays:
            lines.append(self.kernel.pick([
                f"for (uint j = 0; j < {size}; j++) {name}[j] = {self.uniform()} + j;",
                f"if (l == 0) for (uint j = 0; j < {size}; j++) {name}[j] = {self.value()};",
                " ".join(f"{name}[{j}] = {self.uniform()};" for j in range(size)),
                f"for (uint j = l; j < {size}; j += n) {name}[j] = j * 5u;"]))
        return "  " + "\n  ".join(lines) + f"\n  {BARRIER}\n"

    def value(self):
        return self.kernel.value(1)

    def uniform(self):
        return self.kernel.uniform(1)

    def one(self):
        """Tells one work-item of the group from the others."""
        return self.kernel.pick(["l == 0", "l == n - 1", f"l == ({self.uniform()}) % n", "l == n / 2"])

    def first(self, name):
        """A variable's first value, from all or from one."""
        return self.kernel.pick([f"{name} = {self.uniform()};", f"{name} = 0;", f"if ({self.one()}) {name} = {self.value()};"])

    def last(self, name):
        """A variable's value after another barrier."""
        return self.kernel.pick([f"if ({self.one()}) {name} = {self.value()};", f"if ({self.one()}) {name} += {self.value()};",
                                 f"if ({self.kernel.condition()}) {name} = 1;", f"{name} = {self.uniform()};"])

    def read(self, text, alike=True):
        """`alike`: all work-items of the group read the same."""
        if alike and self.kernel.chance(0.25):
            return f"{self.kernel.pick('uv')} = (uint)({text});"
        return f"{self.kernel.pick('xyz')} {self.kernel.pick(['^=', '+=', '='])} (uint)({text});"

    def statement(self):
        makers = [self.told, self.told, self.told, self.kept_value, self.array, self.array, self.part, self.passed, self.passed, self.chosen,
                  self.scan, self.row, self.byte, self.through_pointer, self.quad, self.unread, self.dynamic_parts]
        return self.kernel.pick(makers)() or self.told()

    def told(self):
        name = self.kernel.pick(self.scalars)[0]
        steps = [self.first(name)]
        steps += [self.last(name) for _ in range(self.kernel.random.randint(0, 2))]
        return f" {BARRIER} ".join(steps + [self.read(name)]) + f" {BARRIER}"

    def kept_value(self):
        """What an earlier statement left, or the start."""
        if self.kept and self.kernel.chance(0.6):
            name = self.kernel.pick(self.kept)
            change = f"{BARRIER} if ({self.one()}) {name} += {self.value()};" if self.kernel.chance(0.6) else ""
            return f"{self.read(name)} {change} {BARRIER}"
        if not self.kept_arrays:
            return None
        name, size = self.kernel.pick(self.kept_arrays)
        change = f"{BARRIER} if (l < {size}) {name}[l] ^= {self.value()};" if self.kernel.chance(0.6) else ""
        return f"{self.read(f'{name}[({self.value()}) % {size}u]', False)} {change} {BARRIER}"

    def array(self):
        name, size = self.kernel.pick(self.arrays)
        first = self.kernel.pick([
            f"for (uint j = 0; j < {size}; j++) {name}[j] = {self.uniform()};",
            " ".join(f"{name}[{j}] = {self.kernel.random.randint(0, 9)}u;" for j in range(size)),
            f"if (l == 0) for (uint j = 0; j < {size}; j++) {name}[j] = {self.value()};"])
        change = self.kernel.pick([f"if (l < {size}) {name}[l] += {self.value()};", f"atomic_add(&{name}[({self.value()}) % {size}u], l + 1);",
                                   f"if ({self.one()}) {name}[({self.value()}) % {size}u] = {self.value()};"])
        return f"{first} {BARRIER} {change} {BARRIER} {self.read(f'{name}[({self.value()}) % {size}u]', False)} {BARRIER}"

    def part(self):
        if not self.parts:
            return None
        name, at = self.kernel.pick(self.parts), self.kernel.pick(["0", "1", f"({self.uniform()}) & 1u"])
        element = f"{name}[{at}]"
        first = f"{element}.a = {self.uniform()}; {element}.b[0] = {element}.b[1] = 3; {element}.c = 0.25f;"
        if self.kernel.chance(0.4):
            first = f"if ({self.one()}) {{ {first} }}"
        change = self.kernel.pick([f"if ({self.one()}) {{ {element}.a = {self.value()}; {element}.b[1] = (ushort)({self.value()}); }}",
                                   f"if ({self.one()}) {element} = turned(&{element}, {self.value()});",
                                   f"if ({self.one()}) {element}.c = (float)(int)({self.value()});"])
        # The words come last: they may go to `u` or `v`, which choose the element.
        return (f"{first} {BARRIER} {change} {BARRIER} f += {element}.c; "
                f"{self.read(f'{element}.a + {element}.b[0] * 7u + {element}.b[1]')} {BARRIER}")

    def passed(self):
        """To functions, some of which have barriers."""
        places = [f"&{name}" for name in self.words] + [f"{name} + {size - 1}" for name, size in self.arrays]
        at = self.kernel.pick(places)
        name, size = self.kernel.pick(self.arrays)
        return self.kernel.pick([
            f"set({at}, {self.uniform()}); {BARRIER} if ({self.one()}) set({at}, {self.value()}); {BARRIER} {self.read(f'*({at})')} {BARRIER}",
            f"{self.read(f'told_by({at}, ({self.uniform()}) % n, {self.value()})')}",
            f"for (uint j = 0; j < {size}; j++) set({name} + j, j); {BARRIER} if (l < {size}) add_to({name}, l, {self.value()}); "
            f"{BARRIER} {self.read(f'sum_of({name}, {size})')} {BARRIER}"])

    def chosen(self):
        """One of two variables, by what the group agrees in."""
        places = [f"&{name}" for name in self.words] + [name for name, _ in self.arrays]
        q, a, b = self.kernel.fresh("q"), self.kernel.pick(places), self.kernel.pick(places)
        return (f"{{ local uint *{q} = {self.kernel.agreed()} ? {a} : {b}; *{q} = {self.uniform()}; {BARRIER} "
                f"if ({self.one()}) *{q} = {self.value()}; {BARRIER} {self.read(f'*{q}')} {BARRIER} }}")

    def scan(self):
        """Sums of all work-items up to one's own, as scans and sorts do it."""
        d, add = self.kernel.fresh("d"), self.kernel.fresh("add")
        return (f"t[l] = {self.value()}; {BARRIER}\n  for (uint {d} = 1; {d} < n; {d} *= 2) {{ uint {add} = l >= {d} ? t[l - {d}] : 0; {BARRIER} "
                f"t[l] += {add}; {BARRIER} }}\n  {self.read('t[l]', False)} {self.read('t[n - 1]')} {BARRIER}")

    def row(self):
        if not self.rows:
            return None
        by = self.uniform()
        return (f"for (uint j = 0; j < 3; j++) rows[l][j] = {self.value()} + j; {BARRIER} "
                f"{self.read(f'rows[(l + {by}) % n][({self.value()}) % 3u]', False)} {BARRIER}")

    def byte(self):
        if not self.bytes:
            return None
        return f"bytes[l] = (uchar)({self.value()}); {BARRIER} {self.read(f'bytes[(l * 5u + {self.uniform()}) % n] + bytes[n - 1 - l]', False)} {BARRIER}"

    def through_pointer(self):
        if not self.pointer:
            return None
        (first, _), (second, size) = self.kernel.pick(self.arrays), self.kernel.pick(self.arrays)
        return (f"place = {first}; {BARRIER} if ({self.one()}) place = {second} + ({self.value()}) % {size}u; {BARRIER} "
                f"if ({self.one()}) *place = {self.value()}; {BARRIER} {self.read('*place')} {BARRIER}")

    def quad(self):
        if not self.vector:
            return None
        return (f"quad = (uint4)({self.uniform()}); {BARRIER} if ({self.one()}) quad.{self.kernel.pick('xyzw')} = {self.value()}; {BARRIER} "
                f"{self.read('quad.x + quad.y * 3u + quad.z * 5u + quad.w * 7u')} {BARRIER}")

    def unread(self):
        """Written, and perhaps never read."""
        name, _ = self.kernel.pick(self.scalars)
        if name in self.kept:
            return None
        return f"{BARRIER} {self.first(name)} {BARRIER}"

    def dynamic_parts(self):
        """Structures in the memory that the host gives, behind `t`."""
        place = f"((local part *)(t + n))[{self.kernel.pick(['0', 'n - 1'])}]"
        return (f"{place}.a = {self.uniform()}; {place}.c = 2.0f; {BARRIER} if ({self.one()}) {place}.a = {self.value()}; {BARRIER} "
                f"{self.read(f'{place}.a')} f += {place}.c; {BARRIER}")
