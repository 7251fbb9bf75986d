#!/usr/bin/env python3
"""Prints an assembly file with a line for every SIMT instruction and CSR, and
what the encoding (CHECK) and the disassembly (DIS) of each must be.

usage: every_record.py ROOT
"""

import os
import sys

sys.path.insert(0, os.path.join(sys.argv[1], "intrinsics", "generate"))
from records import Records  # pylint: disable=wrong-import-position

# Other registers for each operand, so that a swap of two shows.
REGISTERS = {"rd": ("a0", 10, 7), "rs1": ("t2", 7, 15), "rs2": ("s3", 19, 20)}


def lines(text, word):
    encoding = ",".join(f"0x{byte:02x}" for byte in word.to_bytes(4, "little"))
    yield f"# CHECK: {text}"
    yield f"# CHECK-SAME: encoding: [{encoding}]"
    yield f"# DIS: {word:08x} {text}"
    yield text.replace("\t", " ")


def main():
    records = Records()
    for i in records.of("SimtInstruction"):
        operands = [x for part in (i.Outs, i.Ins) for x in part.split(", ") if x]
        word = i.Match & 0xFFFFFFFF
        for name in operands:
            word |= REGISTERS[name][1] << REGISTERS[name][2]
        print("\n".join(lines(f"{i.Mnemonic}\t{', '.join(REGISTERS[x][0] for x in operands)}", word)))
    for c in records.of("Csr"):
        # csrrs rd, csr, x0 and csrrw x0, csr, rs1 of Zicsr.
        print("\n".join(lines(f"csrrs\ta0, {c.Name}, zero", c.Number << 20 | 2 << 12 | 10 << 7 | 0x73)))
        if c.Rule.Name != "none":
            print("\n".join(lines(f"csrrw\tzero, {c.Name}, t2", c.Number << 20 | 7 << 15 | 1 << 12 | 0x73)))


main()
