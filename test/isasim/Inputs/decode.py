"""Compares the simulator's disassembly of random words with llvm-objdump's.

usage: decode.py DECODE_WORDS FOLDER INTRINSICS
DECODE_WORDS: the program isasim-decode-words. Half of the words are records
of INTRINSICS with random fields, half are noise in 32-bit encodings.
"""

import os
import random
import re
import subprocess
import sys

decode_words, folder, intrinsics = sys.argv[1:]
sys.path.insert(0, os.path.join(intrinsics, "generate"))
from records import Records  # noqa: E402

random.seed(20)
words = []
for insn in Records().of("Instruction"):
    if insn.Extension == "xvortex":
        continue
    for _ in range(60):
        words.append((random.getrandbits(32) & ~insn.Mask | insn.Match) & 0xFFFFFFFF)
while len(words) < 20000:
    word = random.getrandbits(32) | 3
    if word & 0x1F != 0x1F:  # longer encodings begin so
        words.append(word)

ours = subprocess.run([decode_words], input="\n".join(f"{w:x}" for w in words), text=True, check=True,
                      stdout=subprocess.PIPE).stdout.splitlines()

raw, elf = os.path.join(folder, "words.bin"), os.path.join(folder, "words.o")
with open(raw, "wb") as out:
    for w in words:
        out.write(w.to_bytes(4, "little"))
subprocess.run(["llvm-objcopy-19", "-I", "binary", "-O", "elf32-littleriscv", raw, elf], check=True)
attributes = "+m,+zaamo,+zalrsc,+f,+zicsr,+zifencei,+zicond,+experimental-zacas,+zba,+zbb,+zbs"
listing = subprocess.run(["llvm-objdump-19", "-D", "--triple=riscv32", f"--mattr={attributes}", "-M", "no-aliases",
                          "--no-print-imm-hex", "--section=.data", elf], text=True, check=True, stdout=subprocess.PIPE).stdout
theirs = {}
for line in listing.splitlines():
    match = re.match(r"\s*([0-9a-f]+):\s+[0-9a-f]{8}\s+(.*)", line)
    if match:
        theirs[int(match[1], 16)] = re.sub(r"\s*<[^>]*>$", "", match[2].removesuffix(", dyn")).strip() or "<unknown>"

# What the machine leaves out, and privileged instructions.
left_out = re.compile(r"(lr\.w|sc\.w|mret|sret|wfi|sfence|hfence|hinval|sinval|fence|unimp|dret|mnret|ebreak|"
                      r"ecall|hlv|hsv)")


def same(our, their):
    # LLVM 19 prints shift amounts above 31, which RV32 reserves.
    wide_shift = re.search(r"^(s[lr][la]i|rori|b(clr|ext|inv|set)i)\b.* (3[2-9]|[45]\d|6[0-3])$", their)
    if our.startswith(".word") and wide_shift:
        return True
    if our.startswith(".word"):
        return their.startswith("<unknown>") or "unknown" in their or left_out.match(their) is not None
    if our.startswith(("fence", "vx_")):
        # Reserved fields of fences are ignored here; vx_* is ours alone.
        return True
    if our.startswith("csr"):
        # Each names CSRs of its own: compare the rest.
        if their == "unimp":
            return True
        def strip(text):
            fields = re.split(r"[\t, ]+", text)
            return fields[:2] + fields[3:]
        return strip(our) == strip(their)
    return re.split(r"[\t, ]+", our) == re.split(r"[\t, ]+", their)


different = [(w, a, theirs.get(4 * n, "nothing")) for n, (w, a) in enumerate(zip(words, ours))
             if not same(a, theirs.get(4 * n, "nothing"))]
for word, our, their in different[:20]:
    print(f"{word:08x}: ours '{our}', objdump '{their}'")
decoded = sum(not text.startswith(".word") for text in ours)
print(f"{len(words)} words, {decoded} instructions, {len(different)} differences")
