"""csmith's programs, changed so that every lane runs one with global variables of its own, which start otherwise in each."""

import os
import random
import re
import subprocess


LANES = 16
# A misaligned access, which a packed structure leads to, traps on the machine. The rest keeps programs small.
OPTIONS = ["--no-packed-struct", "--no-argc", "--max-funcs", "4", "--max-block-depth", "4", "--max-expr-complexity", "5",
           "--max-array-dim", "2", "--max-array-len-per-dim", "5"]
GLOBAL = re.compile(r"static (.*?)\b(g_\d+)((?:\[\d+\])*) = (.*);(?:/\*.*\*/)?")
INTEGER = re.compile(r"(?:volatile )?u?int(?:8|16|32|64)_t *")


def generate(seed, folder):
    """What csmith writes. It notes the sizes of its types in its working directory."""
    with open(os.path.join(folder, "platform.info"), "w", encoding="utf-8") as file:
        file.write("integer size = 4\npointer size = 4\n")
    return subprocess.run(["csmith", "--seed", str(seed), *OPTIONS], cwd=folder, check=True, stdout=subprocess.PIPE,
                          text=True, timeout=60).stdout


def source(seed, folder):
    """One program for all lanes: its globals become the members of a structure of which each lane has one."""
    text = generate(seed, folder)
    rand = random.Random(seed)
    head, rest = text.split("/* --- FORWARD DECLARATIONS --- */")
    fields, starts, changes = [], [], []

    def take(found):
        kind, name, size, start = found.groups()
        fields.append(f"  {kind}{name}{size};\n")
        start = re.sub(r"\bg_\d+\b", r"here.\g<0>", start)
        starts.append(f"    .{name} = {start},\n")
        if not size and INTEGER.fullmatch(kind) and rand.random() < 0.7:
            changes.append(f"  G.{name} ^= {rand.choice(['LANE', 'LANE * 0x9e3779b1u', 'LANE >> 2', '(LANE & 1) * 0xffu'])};\n")
        return ""

    head = re.sub(f"^{GLOBAL.pattern}$", take, head, flags=re.M)
    rest = re.sub(r"\bg_\d+\b", r"G.\g<0>", rest).replace("int main (void)", "static int check_lane(void)")
    return (f"{head}struct globals {{\n{''.join(fields)}  uint none;\n}};\nstatic struct globals *Here[{LANES}];\n"
            "#define G (*Here[LANE])\n"
            f"static void perturb(void) {{\n{''.join(changes)}}}\n"
            "/* --- FORWARD DECLARATIONS --- */" + rest +
            "NOINLINE uint run_lane(void) {\n"
            f"  struct globals here = {{\n{''.join(starts)}  }};\n  Here[LANE] = &here;\n  return (uint)check_lane();\n}}\n"
            "static void run_kernels(uint *out, uint *local, uint n, uint lanes, uint number) {\n"
            "  EACH_LANE out[number * lanes + LANE] = run_lane();\n}\n"
            f"enum {{ KERNELS = 1, KERNEL_WORDS = {LANES} + SHARED_WORDS, LANES = {LANES}, GROUPS = 1, ARGUMENT = 0 }};\n"
            '#include "entry.h"\n')
