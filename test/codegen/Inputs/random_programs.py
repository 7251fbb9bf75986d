#!/usr/bin/env python3
"""Random kernels, compiled for the device at several levels and for the host.

usage: random_programs.py [--count N] [--first SEED] [--levels 0,1,2,3] [--keep FOLDER]

Sixteen lanes run a program with other numbers each; on the host a loop runs it
lane after lane. Both write one buffer, which must be equal. Prints a line for
each program that differs, or that the compiler refuses, and the counts; exit
code 1 if any differs.
"""

import argparse
import collections
import concurrent.futures
import os
import random
import subprocess
import sys
import tempfile

LANES = 16
WORDS = 8  # of the buffer for each lane, plus as many shared ones

PROLOGUE = """
#ifdef __riscv
#include <vorion.h>
#define LANE vx_thread_id()
#else
#include <stdio.h>
typedef unsigned uint;
static uint Lane;
#define LANE Lane
#endif
#define NOINLINE __attribute__((noinline)) static
typedef unsigned long long ulong;
typedef struct { uint *out; uint n; } arguments;
static const uint table[8] = {3, 1, 4, 1, 5, 9, 2, 6};
static inline float asfloat(uint x) { return (float)(int)x; }
static inline uint asbits(float f) {
  union { float f; uint u; } both = {f};
  return f != f ? 0x7fc00000 : both.u;
}
NOINLINE uint loop(uint a, uint b) { if (a & 1) return a * b; while (b & 3) b++; return a ^ b; }
NOINLINE uint nested(uint a, uint b) {
  uint r = 0;
  for (uint i = 0; i < (a & 7); i++) {
    for (uint j = 0; j < (b & 7); j++) { if ((i ^ j) == (a & 3)) goto next; if (j * i > 9) return r; r += i * j + 1; }
    r ^= a;
  next:;
  }
  return r;
}
NOINLINE float round_to(float x, uint how) {
  switch (how & 3) {
  case 0: return __builtin_floorf(x * 0.37f);
  case 1: return __builtin_ceilf(x * 0.61f);
  case 2: return __builtin_truncf(x * 1.9f);
  default: return __builtin_rintf(x * 0.5f);
  }
}
"""

EPILOGUE = """
#ifdef __riscv
void _pocl_kernel_k_workgroup(const arguments *a, const vx_launch *l, uint x, uint y, uint z) {
  program(a->out, a->n);
}
static const vx_kernel_arg argument_list[] = {
    {(uint)"out", VX_ARG_GLOBAL, 0, 4}, {(uint)"n", VX_ARG_VALUE, 4, 4}};
__attribute__((section("vorion_kernels"), used)) static const vx_kernel kernel = {
    (uint)"k", (uint)_pocl_kernel_k_workgroup, (uint)argument_list, 2, 8, 0, 0, {0, 0, 0}};
#else
int main(int argc, char **argv) {
  static uint out[%d];
  for (Lane = 0; Lane < %d; Lane++)
    program(out, 5);
  FILE *f = fopen(argv[1], "wb");
  fwrite(out, 1, sizeof out, f);
  return fclose(f);
}
#endif
""" % (WORDS * (LANES + 1), LANES)


class Generator:
    """One program. Variables: x y z differ between lanes, u v start equal, f g are floats."""

    def __init__(self, seed):
        self.random = random.Random(seed)
        self.labels = 0
        self.targets = ["end", "almost"]

    def pick(self, choices):
        return self.random.choice(choices)

    def integer(self, depth=0):
        r = self.random.random()
        if depth > 2 or r < 0.3:
            return self.pick(["x", "y", "z", "t", "u", "v", "n", f"{self.random.randint(0, 9)}u"])
        a, b = self.integer(depth + 1), self.integer(depth + 1)
        if r < 0.40:
            return f"({self.condition(depth + 1)} ? {a} : {b})"
        if r < 0.44:
            return f"table[({a}) & 7]"
        if r < 0.48:
            return f"local[({a}) & 3]"
        if r < 0.52:
            return f"(uint)({self.floating(depth + 1)} > {self.floating(depth + 1)})"
        if r < 0.55:
            return f"({a}) {self.pick(['/', '%'])} (({b}) | 1)"
        if r < 0.58:
            return f"{self.pick(['loop', 'nested'])}({a}, {b})"
        if r < 0.62:
            return f"(uint)({self.long(depth + 1)} >> {self.pick([0, 7, 32, f'({a} & 63)'])})"
        return f"({a} {self.pick(['+', '-', '*', '^', '&', '|'])} {b})"

    def long(self, depth):
        a = self.integer(depth + 1)
        if depth > 2 or self.random.random() < 0.3:
            return self.pick(["w", f"((ulong)({a}) << 20)"])
        if self.random.random() < 0.3:
            return f"({self.condition(depth + 1)} ? {self.long(depth + 1)} : {self.long(depth + 1)})"
        return f"({self.long(depth + 1)} {self.pick(['+', '-', '*', '^'])} {self.long(depth + 1)})"

    def floating(self, depth=0):
        r = self.random.random()
        if depth > 2 or r < 0.35:
            return self.pick(["f", "g", "1.5f", "-0.25f", "100.0f"])
        a, b = self.floating(depth + 1), self.floating(depth + 1)
        if r < 0.50:
            return f"({self.condition(depth + 1)} ? {a} : {b})"
        if r < 0.58:
            return f"round_to({a}, {self.integer(2)})"
        if r < 0.66:
            return f"asfloat(({self.integer(2)}) & 0xffff)"
        if r < 0.74:
            return f"__builtin_{self.pick(['floorf', 'ceilf', 'truncf', 'rintf', 'fabsf'])}({a})"
        return f"({a} {self.pick(['+', '-', '*'])} {b})"

    def condition(self, depth=0):
        r = self.random.random()
        if r < 0.15 and depth < 3:
            return f"({self.condition(depth + 1)} {self.pick(['&&', '||'])} {self.condition(depth + 1)})"
        if r < 0.3:
            return f"({self.pick(['u', 'v', 'n', 'table[u & 7]'])} & {self.pick([1, 2, 3])})"
        if r < 0.42:
            return f"({self.floating(2)} {self.pick(['<', '>=', '==', '!='])} {self.floating(2)})"
        if r < 0.47 and depth < 3:
            return f"({self.long(2)} {self.pick(['<', '==', '>='])} {self.long(2)})"
        return (f"(({self.integer(2)} & {self.pick([1, 2, 3, 4, 7])}u) {self.pick(['==', '!=', '<', '>'])} "
                f"{self.random.randint(0, 4)}u)")

    def simple(self):
        r = self.random.random()
        if r < 0.55:
            return f"{self.pick('xyz')} = {self.integer()};"
        if r < 0.7:
            return f"{self.pick('fg')} = {self.floating()};"
        if r < 0.8:
            return f"local[({self.integer(2)}) & 3] = {self.integer(1)};"
        if r < 0.84:
            return f"w = {self.long(0)};"
        if r < 0.89:
            return f"{self.pick('uv')} = {self.integer(1)};"
        return self.atomic()

    def atomic(self):
        # Sums of the shared words commute; what an atomic returns is only used on the lane's own word.
        if self.random.random() < 0.4:
            return f"__atomic_fetch_add(&shared[({self.integer(2)}) & 3], {self.integer(2)}, 0);"
        if self.random.random() < 0.3:
            return f"__atomic_fetch_add((unsigned char *)shared + 16 + (({self.integer(2)}) & 15), {self.integer(2)}, 0);"
        op = self.pick(["add", "and", "or", "xor", "nand", "sub"])
        return f"{self.pick('xyz')} = __atomic_fetch_{op}(&own[7], {self.integer(2)}, 0);"

    def block(self, depth, in_loop):
        return " ".join(self.statement(depth, in_loop) for _ in range(self.random.randint(1, 4)))

    def loop(self, depth):
        self.labels += 1
        i = f"i{self.labels}"
        bound = self.pick([f"({self.integer(1)} & 7u)", "(n & 3u)", "(u & 3u)"])
        body = self.block(depth + 1, True)
        kind = self.random.random()
        if kind < 0.6:
            return f"for (uint {i} = 0; {i} < {bound}; {i}++) {{ {body} }}"
        if kind < 0.8:
            return f"{{ uint {i} = 0; do {{ {body} }} while (++{i} < 5 && {self.condition()}); }}"
        return f"{{ uint {i} = 0; while (1) {{ if (++{i} > {bound}) break; {body} }} }}"

    def crossed_loop(self, depth):
        """A loop that is entered in two places."""
        self.labels += 1
        k = f"k{self.labels}"
        return (f"{{ uint {k} = 0; if ({self.condition()}) goto middle{k}; top{k}: {self.block(depth + 1, False)} "
                f"middle{k}: {self.block(depth + 1, False)} if (++{k} < 4 && {self.condition()}) goto top{k}; }}")

    def statement(self, depth, in_loop):
        r = self.random.random()
        if depth > 3 or r < 0.4:
            return self.simple()
        if r < 0.62:
            other = f" else {{ {self.block(depth + 1, in_loop)} }}" if self.random.random() < 0.6 else ""
            return f"if ({self.condition()}) {{ {self.block(depth + 1, in_loop)} }}{other}"
        if r < 0.74:
            return self.loop(depth)
        if r < 0.77:
            return self.crossed_loop(depth)
        if r < 0.84:
            cases = " ".join(f"case {n}: {self.block(depth + 1, in_loop)} {self.pick(['break;', ''])}"
                             for n in self.random.sample(range(6), 3))
            return f"switch ({self.integer()} & 7u) {{ {cases} default: {self.block(depth + 1, in_loop)} }}"
        if r < 0.92 and in_loop:
            return f"if ({self.condition()}) {self.pick(['break;', 'continue;'])}"
        if r < 0.95:
            return f"if ({self.condition()}) {{ own[0] = x + 3 * y + 7 * z; return; }}"
        if r < 0.98:
            return f"if ({self.condition()}) goto {self.pick(self.targets)};"
        return self.simple()

    def program(self):
        first = self.block(0, False)
        self.targets = ["end"]  # forward only, or programs might not end
        second = self.block(0, False)
        return (PROLOGUE + "static void program(uint *out, uint n) {\n"
                "  uint t = LANE, x = t * 7u + n, y = t ^ 5u, z = 3, u = n, v = n * 3u;\n  ulong w = (ulong)t << 33 | 77;\n"
                "  float f = asfloat(t) * 1.25f, g = asfloat(n);\n"
                f"  uint *shared = out, *own = out + {WORDS} * (t + 1), local[4] = {{1, t, n, 4}};\n"
                f"  {first}\n almost:\n  {second}\n"
                " end:\n  own[0] = x + y * 5u + z * 11u; own[1] = u; own[2] = v; own[3] = asbits(f); own[4] = asbits(g);\n"
                "  own[5] = local[0] ^ local[1] ^ local[2] ^ local[3]; own[6] = (uint)(w ^ w >> 32);\n}\n" + EPILOGUE)


def run(command):
    return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False, timeout=300)


def contents(path):
    with open(path, "rb") as file:
        return file.read()


def check(seed, levels, folder):
    """[(level, "same", "refused: ..." or "WRONG: ...")]"""
    base = os.path.join(folder, str(seed))
    source = base + ".c"
    with open(source, "w", encoding="utf-8") as file:
        file.write(Generator(seed).program())
    host = run(["clang-19", "-w", "-O1", "-ffp-contract=off", source, "-o", base + ".host", "-lm"])
    if host.returncode:
        raise RuntimeError(f"seed {seed}: the host's compiler fails: {host.stderr}")
    run([base + ".host", base + ".expected"])
    results = []
    for level in levels:
        elf, out = f"{base}.O{level}.elf", f"{base}.O{level}.out"
        compiled = run(["vorion-clang", "-w", f"-O{level}", source, "-o", elf])
        if compiled.returncode:
            errors = [line for line in compiled.stderr.splitlines() if "error" in line]
            results.append((level, "refused: " + "; ".join(errors[:2])))
            continue
        ran = run(["vorion-sim", "--max-instructions", "20000000", elf, "--global", str(LANES), "--local", str(LANES),
                   "--arg", f"out:{4 * WORDS * (LANES + 1)}@{out}", "--arg", "u32:5"])
        if ran.returncode:
            results.append((level, "WRONG: " + " ".join(ran.stderr.split())[:200]))
        elif contents(out) != contents(base + ".expected"):
            results.append((level, "WRONG: other results than the host's"))
        else:
            results.append((level, "same"))
    for name in os.listdir(folder):
        if name.startswith(f"{seed}.") and all(r == "same" for _, r in results):
            os.remove(os.path.join(folder, name))
    return results


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=20)
    parser.add_argument("--first", type=int, default=1)
    parser.add_argument("--levels", default="0,1,2,3")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--keep", help="folder for the programs that differ or are refused")
    options = parser.parse_args()
    levels = options.levels.split(",")
    counts = collections.Counter()
    with tempfile.TemporaryDirectory() as scratch:
        folder = options.keep or scratch
        os.makedirs(folder, exist_ok=True)
        seeds = range(options.first, options.first + options.count)
        with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
            for seed, results in zip(seeds, pool.map(lambda s: check(s, levels, folder), seeds)):
                for level, result in results:
                    counts[result.split(":")[0]] += 1
                    if result != "same":
                        print(f"seed {seed} -O{level}: {result}", flush=True)
    print(f"{counts['same']} same, {counts['refused']} refused, {counts['WRONG']} wrong")
    return counts["WRONG"] > 0


if __name__ == "__main__":
    sys.exit(main())
