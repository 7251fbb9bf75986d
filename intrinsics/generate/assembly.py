#!/usr/bin/env python3
"""Writes the ABI's numbers for assembly or for a linker script.

usage: assembly.py [--tblgen PATH] --format asm|ld OUTPUT
asm: #define lines of the constants, and VX_<STRUCT>_<FIELD>, each field's byte offset.
ld: assignments of the image's place and size (each becomes a symbol of the program, so no more than these).
"""

import argparse

from records import Records, write


def numbers(records):
    for c in records.of("Constant"):
        yield c.Name, c.Value & 0xFFFFFFFF


def offsets(records):
    for d in records.of("Descriptor"):
        offset = 0
        for f in d.Fields:
            yield f"{d.Name}_{f.Name}".upper(), offset
            offset += 4 * f.Count


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--tblgen", default="llvm-tblgen-19")
    parser.add_argument("--format", choices=("asm", "ld"), required=True)
    parser.add_argument("output")
    options = parser.parse_args()
    records = Records(options.tblgen)
    note = "Generated from the records of intrinsics/ by intrinsics/generate/assembly.py; do not edit."
    lines = [f"/* {note} */"]
    if options.format == "asm":
        lines += [f"#define {name} {value:#x}" for name, value in [*numbers(records), *offsets(records)]]
    else:
        lines += [f"{name} = {value:#x};" for name, value in numbers(records) if name.startswith("VX_IMAGE_")]
    write(options.output, "\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
