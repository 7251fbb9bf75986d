#!/usr/bin/env python3
"""Writes the ABI's numbers for assembly or for a linker script.

usage: assembly.py [--tblgen PATH] --format asm|ld OUTPUT
asm: #define lines of the constants, of VX_CSR_<NAME>, a CSR's number, of VX_<STRUCT>_<FIELD>, a field's byte offset, and of
SIZEOF_VX_<STRUCT>, its bytes.
ld: assignments of the image's place and size (each becomes a symbol of the program, so no more than these).
"""

import argparse

from printing import csr_macro, note, word
from records import Records, write


def numbers(records):
    for c in records.of("Constant"):
        yield c.Name, c.Value


def csrs(records):
    for c in records.of("Csr"):
        yield csr_macro(c), c.Number


def offsets(records):
    for d in records.of("Descriptor"):
        offset = 0
        for f in d.Fields:
            yield f"{d.Name}_{f.Name}".upper(), offset
            offset += 4 * f.Count
        yield f"SIZEOF_{d.Name}".upper(), offset


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--tblgen", default="llvm-tblgen-19")
    parser.add_argument("--format", choices=("asm", "ld"), required=True)
    parser.add_argument("output")
    options = parser.parse_args()
    records = Records(options.tblgen)
    lines = [note("assembly.py", "/*", "*/")]
    if options.format == "asm":
        known = [*numbers(records), *csrs(records), *offsets(records)]
        lines += [f"#define {name} {word(value)}" for name, value in known]
    else:
        lines += [f"{name} = {word(value)};" for name, value in numbers(records) if name.startswith("VX_IMAGE_")]
    write(options.output, "\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
