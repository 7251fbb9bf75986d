#!/usr/bin/env python3
"""Writes the simulator's instructions, constants and descriptors as a C++ header (csrs.py writes the CSRs, raster.py
what is the rasterizer's).

usage: isasim.py [--tblgen PATH] OUTPUT
"""

import argparse

from printing import Cpp, camel, flag, note, word
from raster import is_raster
from records import Records, write

HEAD = note("isasim.py") + """
#pragma once

#include "core/CsrTable.h"

#include <cstdint>

namespace vorion::isasim {

enum class Format : uint8_t { R, R4, I, S, B, U, J, IShift, ICsr, ICsrImm, Plain };

/// Which register file an operand names; None where there is no such operand.
enum class File : uint8_t { None, X, F };

/// An instruction: Word & Mask == Match. Syntax is the assembly's operands.
struct InsnInfo {
  const char *Mnemonic;
  const char *Syntax;
  uint32_t Match, Mask;
  Format Fmt;
  File Rd, Rs1, Rs2, Rs3;
  bool HasRm; ///< a rounding mode stands where funct3 is
  bool Pairs; ///< rd and rs2 are each the even one of two neighbours
};
"""


def syntax(insn):
    if hasattr(insn, "Syntax"):
        return insn.Syntax
    return ", ".join(part for part in (insn.Outs, insn.Ins) if part)


def file_of(operands, register):
    names = operands.replace("(", " ").replace(")", " ").replace(",", " ").split()
    return "F" if "f" + register in names else "X" if register in names else "None"


def instructions(records):
    insns = records.of("Instruction")
    yield "/// Applies X to every instruction: X(record name)."
    yield "#define VORION_FOR_EACH_OP(X) \\"
    yield " \\\n".join(f"  X({i.id})" for i in insns)
    yield ""
    yield "enum class Op : uint16_t {"
    for i in insns:
        yield f"  {i.id},"
    yield "};"
    yield f"inline constexpr unsigned NumOps = {len(insns)};\n"
    yield "/// Indexed by Op."
    yield "inline constexpr InsnInfo InsnTable[NumOps] = {"
    for i in insns:
        operands = syntax(i)
        files = ", ".join(f"File::{file_of(operands, r)}" for r in ("rd", "rs1", "rs2", "rs3"))
        yield (f'    {{"{i.Mnemonic}", "{operands}", {word(i.Match)}, {word(i.Mask)}, '
               f"Format::{i.Fmt.id}, {files}, {flag(operands.endswith('rm'))}, {flag(i.Pairs)}}},")
    yield "};\n"


def abi(records):
    yield from Cpp().constants(c for c in records.of("Constant") if not is_raster(records, c))
    for d in records.of("Descriptor"):
        if not is_raster(records, d):
            yield from Cpp().structure(camel(d.Name), d.Doc, d.Fields)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--tblgen", default="llvm-tblgen-19")
    parser.add_argument("output")
    options = parser.parse_args()
    records = Records(options.tblgen)
    lines = [HEAD]
    for part in (instructions, abi):
        lines += part(records)
    lines.append("} // namespace vorion::isasim")
    write(options.output, "\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
