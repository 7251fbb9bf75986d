#!/usr/bin/env python3
"""What is in the code of a kernel that PoCL has cached.

usage: code_of.py CACHE KERNEL WORD...
Prints how often each WORD is there: a mnemonic or the name of a CSR in the disassembly, or a number as a
32-bit constant among the read-only data or put together by lui and addi. A kernel that is not in CACHE is "not built".
"""

import glob
import os
import re
import struct
import subprocess
import sys

cache, kernel, *words = sys.argv[1:]
found = glob.glob(os.path.join(cache, "**", kernel + ".elf"), recursive=True)
if not found:
    print(f"{kernel} not built")
    sys.exit(0)
assert len(found) == 1, found
text = subprocess.run(["vorion-objdump", "-d", "--no-show-raw-insn", found[0]], check=True, capture_output=True,
                      text=True).stdout
data = subprocess.run(["vorion-objdump", "-s", "-j", ".rodata", found[0]], check=True, capture_output=True,
                      text=True).stdout
constants = re.findall(r"\b[0-9a-f]{8}\b", "\n".join(line[9:45] for line in data.splitlines()))
instructions = re.findall(r"\t(\S+)\t?(.*)", text)
upper = {}  # register: what its last lui put there
for name, operands in instructions:
    operands = operands.replace(",", " ").split()
    if name == "lui":
        upper[operands[0]] = int(operands[1], 0) << 12
    elif name == "addi" and operands[1] in upper:
        constants.append(struct.pack("<I", upper[operands[1]] + int(operands[2], 0) & 0xFFFFFFFF).hex())
for word in words:
    if re.fullmatch(r"-?[0-9.e-]+", word):
        bits = struct.pack("<f", float(word)).hex()
        print(kernel, word, constants.count(bits))
    else:
        said = re.compile(rf"(?<![\w.]){re.escape(word)}(?![\w.])")
        print(kernel, word, sum(bool(said.search(" ".join(parts))) for parts in instructions))
