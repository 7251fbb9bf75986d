#!/usr/bin/env python3
"""Gives vorion-clang mutated OpenCL C: it must end with errors in clang's form,
or with an image whose kernels run (to an end, a trap or a limit), never with a
crash. The kernels mutated are this project's, and those of --corpus FOLDER.
Each seed is one case; a find stays in FOLDER as seed-N.cl."""

import glob
import os
import random
import re
import sys

import cases

TOKEN = re.compile(r"\w+|\s+|[^\w\s]")
WORDS = """int uint float char uchar short long ulong float4 int3 size_t bool void kernel global local
constant private const volatile restrict if else for while do return break continue switch case default
goto struct union typedef enum static inline extern double half barrier(1) get_local_id(0)
get_global_id(0) get_local_size(0) 0 1 -1 2147483647 4294967295u 0x7fffffffffffffff 1e38f 0.0f NAN
INFINITY __attribute__((reqd_work_group_size(3,1,1))) __attribute__((packed)) asm("nop") sizeof
atomic_add printf("%d") vload4 convert_int as_float mad fma select { } ( ) [ ] ; , . -> & * + - / % << >>
== != < > && || ! ~ ^ | ? : = += #pragma #define #include""".split()


def mutate(text, texts, chance):
    tokens = TOKEN.findall(text)
    for _ in range(chance.choice([1, 1, 1, 2, 3, 8])):
        if not tokens:
            break
        at = chance.randrange(len(tokens))
        kind = chance.randrange(9)
        if kind == 0:
            del tokens[at:at + chance.choice([1, 1, 2, 10])]
        elif kind == 1:
            tokens[at] = chance.choice(WORDS)
        elif kind == 2:
            tokens.insert(at, " " + chance.choice(WORDS) + " ")
        elif kind == 3:
            tokens[at] = chance.choice(tokens)
        elif kind == 4:
            other = chance.randrange(len(tokens))
            tokens[at], tokens[other] = tokens[other], tokens[at]
        elif kind == 5:
            piece = tokens[at:at + chance.randint(1, 60)]
            to = chance.randrange(len(tokens))
            tokens[to:to] = piece
        elif kind == 6:
            other = TOKEN.findall(chance.choice(texts))
            begin = chance.randrange(len(other))
            tokens[at:at] = other[begin:begin + chance.randint(1, 60)]
        elif kind == 7:  # every use of a name
            name = chance.choice([t for t in tokens if t.isidentifier()] or ["x"])
            word = chance.choice(WORDS)
            tokens = [word if t == name else t for t in tokens]
        else:
            tokens[at] = chr(chance.choice([0, 9, 34, 39, 92, 127, 233, 0x4e2d]))
    return "".join(tokens)


def sources(folders):
    """Texts by name; ours with their headers' folder."""
    found = []
    for folder in folders:
        for path in sorted(glob.glob(os.path.join(folder, "**", "*.cl"), recursive=True)):
            with open(path, errors="replace") as file:
                found.append((os.path.dirname(path), file.read()))
    return found


def kernels_of(image):
    """(name, arguments for vorion-sim) for each kernel of an image."""
    code, output = cases.run(["vorion-sim", image, "--list-kernels"])
    if code != 0:
        raise RuntimeError(f"vorion-sim --list-kernels ended with {code}: {output}")
    found = []
    for line in output.splitlines():
        name, parts = line.split("(", 1)
        given = []
        for argument in filter(None, parts.rsplit(")", 1)[0].split(", ")):
            kind, size = argument.split(" ", 1)[0], int(argument.rsplit("[", 1)[1].rstrip("]"))
            value = "bytes:" + "04" + "00" * (size - 1)
            given += ["--arg", {"global": "buf:65536", "local": "local:1024", "value": value, "integer": value, "float": value}[kind]]
        found.append((name, given))
    return found


def main():
    parser = cases.options(__doc__)
    parser.add_argument("--corpus", action="append", default=[], help="more OpenCL C, mutated too")
    arguments = parser.parse_args()
    root = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "..", "..")
    texts = sources([os.path.join(root, "apps", "splat", "kernels"),
                     os.path.join(root, "test", "opencl", "Inputs")] + arguments.corpus)

    def case(seed):
        chance = random.Random(seed)
        folder, text = chance.choice(texts)
        path = os.path.join(arguments.folder, f"seed-{seed}.cl")
        image = os.path.join(arguments.folder, f"seed-{seed}.elf")
        with open(path, "w", encoding="utf-8", errors="replace") as file:
            file.write(mutate(text, [t for _, t in texts], chance))
        options = chance.choice([[], [], ["-g"], ["-O0", "-g"], ["-cl-fast-relaxed-math"]])
        code, output = cases.run(["vorion-clang", *options, "-I" + folder, path, "-o", image])
        wrong = ""
        if code == 3:
            if "error: " not in output or os.path.exists(image):
                wrong = f"no error, or an image beside it: {output}"
        elif code == 0:
            try:
                for name, given in kernels_of(image):
                    ended, said = cases.run(
                        ["vorion-sim", image, "--kernel", name, "--global", "24",
                         "--set", "max_instructions=200000", "--watchdog", "20", *given])
                    # 2: a group size that the source requires and 24 is no multiple of.
                    if ended not in (0, 1, 2, 4, 5):
                        wrong = f"kernel {name} ended with {ended}: {said}"
            except (RuntimeError, ValueError, KeyError, IndexError) as problem:
                wrong = str(problem)
        else:
            wrong = f"vorion-clang {' '.join(options)} ended with {code}: {output[-2000:]}"
        if os.path.exists(image):
            os.remove(image)
        if not wrong:
            os.remove(path)
        return wrong

    return cases.each(arguments, case)


if __name__ == "__main__":
    sys.exit(main())
