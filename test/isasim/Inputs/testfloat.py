#!/usr/bin/env python3
"""Berkeley TestFloat's cases of single precision, on the simulator's lanes.

GENERATOR is TestFloat's program testfloat_gen, built for RISC-V's NaNs (SPECIALIZE_TYPE=RISCV). It computes each case with
SoftFloat. Results must be the same bit for bit. Exception flags belong to a warp, so cases are ordered by their flags, and
those of 16 lanes are compared together; with --lanes 1 each case is compared alone.

VORION_SET chooses the engine: engine=interpreter, or engine=translator,quantum=1000.

exit codes: 0 all are the same, 1 a case differs or a program fails, 2 usage
"""

import argparse
import collections
import concurrent.futures
import os
import subprocess
import sys
import tempfile

import numpy as np

# Of RISC-V, and TestFloat's options for it.
MODES = {"rne": "near_even", "rtz": "minMag", "rdn": "min", "rup": "max", "rmm": "near_maxMag"}
SIGN = 0x8000_0000
Instruction = collections.namedtuple("Instruction", "function text operands negated takes gives", defaults=((), "float", "float"))
# In the assembly, %0 is the result, %2 to %4 are operands, and @ is the mode. A product that the instruction negates
# gets its first operand negated, a sum that it subtracts the third.
INSTRUCTIONS = {
    "fadd": Instruction("f32_add", "fadd.s %0, %2, %3, @", 2),
    "fsub": Instruction("f32_sub", "fsub.s %0, %2, %3, @", 2),
    "fmul": Instruction("f32_mul", "fmul.s %0, %2, %3, @", 2),
    "fdiv": Instruction("f32_div", "fdiv.s %0, %2, %3, @", 2),
    "fsqrt": Instruction("f32_sqrt", "fsqrt.s %0, %2, @", 1),
    "fmadd": Instruction("f32_mulAdd", "fmadd.s %0, %2, %3, %4, @", 3),
    "fmsub": Instruction("f32_mulAdd", "fmsub.s %0, %2, %3, %4, @", 3, (2,)),
    "fnmsub": Instruction("f32_mulAdd", "fnmsub.s %0, %2, %3, %4, @", 3, (0,)),
    "fnmadd": Instruction("f32_mulAdd", "fnmadd.s %0, %2, %3, %4, @", 3, (0, 2)),
    "feq": Instruction("f32_eq", "feq.s %0, %2, %3", 2, gives="uint"),
    "fle": Instruction("f32_le", "fle.s %0, %2, %3", 2, gives="uint"),
    "flt": Instruction("f32_lt", "flt.s %0, %2, %3", 2, gives="uint"),
    "fcvt.w.s": Instruction("f32_to_i32", "fcvt.w.s %0, %2, @", 1, gives="uint"),
    "fcvt.wu.s": Instruction("f32_to_ui32", "fcvt.wu.s %0, %2, @", 1, gives="uint"),
    "fcvt.s.w": Instruction("i32_to_f32", "fcvt.s.w %0, %2, @", 1, takes="uint"),
    "fcvt.s.wu": Instruction("ui32_to_f32", "fcvt.s.wu %0, %2, @", 1, takes="uint"),
}
WORK_ITEMS = 256
CASES = 1 << 20  # at once, of 16 to 20 bytes


def kernel(instruction, mode, dynamic):
    """OpenCL C. A pass of 16 work-items executes the instruction on 16 cases that lie side by side."""
    constraint = {"float": "f", "uint": "r"}
    operands = ", ".join(f'"{constraint[instruction.takes]}"(in[i * {instruction.operands} + {n}])' for n in range(instruction.operands))
    setting = f"csrwi frm, {list(MODES).index(mode)}\\n\\t" if dynamic else ""
    text = instruction.text.replace("@", "dyn" if dynamic else mode)
    return f"""kernel __attribute__((reqd_work_group_size(16, 1, 1)))
void run(global {instruction.gives} *out, global uint *raised, global const {instruction.takes} *in, uint count) {{
  for (uint i = get_global_id(0); i < count; i += {WORK_ITEMS}) {{
    {instruction.gives} value;
    uint flags;
    __asm__ volatile("{setting}csrwi fflags, 0\\n\\t{text}\\n\\tcsrr %1, fflags"
                     : "=&{constraint[instruction.gives]}"(value), "=&r"(flags) : {operands});
    out[i] = value;
    raised[i] = flags;
  }}
}}
"""


def cases(generator, instruction, mode, level):
    """Operands, results and flags, in pieces: arrays of (n, operands) and (n)."""
    command = [generator, "-level", str(level), "-seed", "1", f"-r{MODES[mode]}", "-tininessafter", "-exact", instruction.function]
    digits = np.full(256, 255, np.uint8)
    digits[np.frombuffer(b"0123456789ABCDEF", np.uint8)] = np.arange(16)
    with subprocess.Popen(command, stdout=subprocess.PIPE) as process:
        first = process.stdout.readline()
        widths = [len(word) for word in first.split()]
        text = first
        while text:
            text += process.stdout.read(CASES * len(first) - len(text))
            lines = digits[np.frombuffer(text, np.uint8).reshape(-1, len(first))]
            words, at = [], 0
            for width in widths:
                word = np.zeros(len(lines), np.uint32)
                for digit in range(at, at + width):
                    word = word << np.uint32(4) | lines[:, digit]
                words.append(word)
                at += width + 1
            yield np.stack(words[:-2], axis=1), words[-2], words[-1]
            text = process.stdout.read(len(first))
    if process.returncode:
        raise RuntimeError(f"{' '.join(command)}: exit code {process.returncode}")


def machine(lanes):
    """The variables with which kernels are compiled for and run on a machine of so many lanes."""
    settings = [f"lanes_per_warp={lanes}", os.environ.get("VORION_SET", "")]
    return {**os.environ, "VORION_SET": ",".join(filter(None, settings))}


def check(chosen, name, mode, dynamic):
    """How many cases were compared, and what is wrong."""
    instruction = INSTRUCTIONS[name]
    count, bad = 0, []
    with tempfile.TemporaryDirectory(prefix="vorion-testfloat-") as folder:
        def at(file):
            return os.path.join(folder, file)
        with open(at("kernel.cl"), "w", encoding="utf-8") as file:
            file.write(kernel(instruction, mode, dynamic))
        subprocess.run(["vorion-clang", at("kernel.cl"), "-o", at("kernel.elf")], env=machine(chosen.lanes), check=True)
        for operands, results, flags in cases(chosen.generator, instruction, mode, chosen.level):
            order = np.argsort(flags, kind="stable")
            operands, results, flags = operands[order], results[order], flags[order]
            for n in instruction.negated:
                operands[:, n] ^= np.uint32(SIGN)
            operands.tofile(at("in"))
            size = 4 * len(results)
            subprocess.run(["vorion-sim", at("kernel.elf"), "--global", str(WORK_ITEMS), "--local", "16",
                            "--arg", f"out:{size}@{at('out')}", "--arg", f"out:{size}@{at('flags')}", "--arg", f"buf@{at('in')}",
                            "--arg", f"u32:{len(results)}"], env=machine(chosen.lanes), check=True)
            got, raised = np.fromfile(at("out"), np.uint32), np.fromfile(at("flags"), np.uint32)
            # Of cases that lie side by side, what any of them raises.
            ends = -len(flags) % chosen.lanes
            together = np.bitwise_or.reduce(np.pad(flags, (0, ends)).reshape(-1, chosen.lanes), axis=1).repeat(chosen.lanes)[:len(flags)]
            for row in np.flatnonzero((got != results) | (raised != together))[:5]:
                bad.append(f"{name} {mode}{' of frm' if dynamic else ''}: operands {' '.join(f'{word:08x}' for word in operands[row])}: "
                           f"{got[row]:08x}, flags {raised[row]:02x}, expected {results[row]:08x}, {together[row]:02x}")
            count += len(results)
    if not count:
        bad.append(f"{name} {mode}: {chosen.generator} prints no case of {instruction.function}")
    return count, bad


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("generator", metavar="GENERATOR")
    parser.add_argument("--instructions", metavar="NAME,...", default=",".join(INSTRUCTIONS), help="only these (all)")
    parser.add_argument("--level", type=int, choices=(1, 2), default=1, help="TestFloat's: how many cases (1)")
    parser.add_argument("--lanes", type=int, choices=(1, 16), default=16, help="of a warp (16)")
    parser.add_argument("--jobs", type=int, default=1)
    chosen = parser.parse_args()
    names = chosen.instructions.split(",")
    for name in names:
        if name not in INSTRUCTIONS:
            parser.error(f"instruction '{name}', expected some of {','.join(INSTRUCTIONS)}")
    todo = []
    for name in names:
        if "@" in INSTRUCTIONS[name].text:
            todo += [(name, mode, dynamic) for mode in MODES for dynamic in (False, True)]
        else:
            todo.append((name, "rne", False))
    counts, wrong = collections.Counter(), 0
    with concurrent.futures.ThreadPoolExecutor(chosen.jobs) as pool:
        for (name, _, _), (count, bad) in zip(todo, pool.map(lambda what: check(chosen, *what), todo)):
            counts[name] += count
            wrong += bool(bad)
            for line in bad:
                print(line)
    for name, count in counts.items():
        print(f"{name}: {count:,} results")
    print(f"{sum(counts.values()):,} results of {len(counts)} instructions, in {len(todo)} programs of which {wrong} are wrong")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
