#!/usr/bin/env python3
"""Writes the simulator's instruction, CSR, constant and descriptor tables as a C++ header.

usage: isasim.py [--tblgen PATH] OUTPUT
"""

import argparse

from records import Records, write

HEAD = """// Generated from intrinsics/*.td by intrinsics/generate/isasim.py; do not edit.
#pragma once

#include <cstdint>

namespace vorion::isasim {

enum class Format : std::uint8_t { R, R4, I, S, B, U, J, IShift, ICsr, ICsrImm, Plain };

/// Which register file an operand names; None where there is no such operand.
enum class File : std::uint8_t { None, X, F };

/// An instruction: Word & Mask == Match. Syntax is the assembly's operands.
struct InsnInfo {
  const char *Mnemonic;
  const char *Syntax;
  std::uint32_t Match, Mask;
  Format Fmt;
  File Rd, Rs1, Rs2, Rs3;
  bool HasRm; ///< a rounding mode stands where funct3 is
};

/// Where one copy of a CSR lives.
enum class Scope : std::uint8_t { Lane, Warp, Core, Agent, Socket, Cluster, Device };
/// What a write by several active lanes means.
enum class WriteRule : std::uint8_t { None, Lane, Scalar, Push };

struct CsrInfo {
  std::uint16_t Number;
  Scope In;
  WriteRule Rule;
  bool Uniform;
  bool Raster; ///< the Raster Agent's
  const char *Name;
};
"""


def hex32(value):
    return f"{value & 0xFFFFFFFF:#x}"


def flag(value):
    return "true" if value else "false"


def camel(name):
    return "".join(part.capitalize() for part in name.split("_"))


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
    yield "enum class Op : std::uint16_t {"
    for i in insns:
        yield f"  {i.id},"
    yield "};"
    yield f"inline constexpr unsigned NumOps = {len(insns)};\n"
    yield "/// Indexed by Op."
    yield "inline constexpr InsnInfo InsnTable[NumOps] = {"
    for i in insns:
        operands = syntax(i)
        files = ", ".join(f"File::{file_of(operands, r)}" for r in ("rd", "rs1", "rs2", "rs3"))
        yield (f'    {{"{i.Mnemonic}", "{operands}", {hex32(i.Match)}, {hex32(i.Mask)}, '
               f"Format::{i.Fmt.id}, {files}, {flag(operands.endswith('rm'))}}},")
    yield "};\n"


def csrs(records):
    table = sorted(records.of("Csr"), key=lambda c: c.Number)
    yield "enum Csr : std::uint16_t {"
    for c in table:
        yield f"  {c.id if c.id.startswith('CSR_') else 'CSR_' + c.id} = {c.Number:#05x},"
    yield "};\n"
    yield "/// By ascending number."
    yield f"inline constexpr unsigned NumCsrs = {len(table)};"
    yield "inline constexpr CsrInfo CsrTable[NumCsrs] = {"
    for c in table:
        yield (f"    {{{c.Number:#05x}, Scope::{camel(c.In.Name)}, WriteRule::{camel(c.Rule.Name)}, "
               f"{flag(c.Uniform)}, {flag(c.Extension == 'xvorion')}, \"{c.Name}\"}},")
    yield "};\n"


def abi(records):
    yield "// The names of the ABI, as in every other language."
    yield "// NOLINTBEGIN(readability-identifier-naming)"
    for c in records.of("Constant"):
        yield f"inline constexpr std::uint32_t {c.Name} = {hex32(c.Value)}; ///< {c.Doc}"
    yield "// NOLINTEND(readability-identifier-naming)"
    yield ""
    kinds = {"u32": "std::uint32_t", "f32": "float"}
    for d in records.of("Descriptor"):
        yield f"/// {d.Doc}"
        yield f"struct {camel(d.Name)} {{"
        for f in d.Fields:
            count = f"[{f.Count}]" if f.Count > 1 else ""
            yield f"  {kinds[f.Type]} {camel(f.Name)}{count}; ///< {f.Doc}"
        yield "};\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--tblgen", default="llvm-tblgen-19")
    parser.add_argument("output")
    options = parser.parse_args()
    records = Records(options.tblgen)
    lines = [HEAD]
    for part in (instructions, csrs, abi):
        lines += part(records)
    lines.append("} // namespace vorion::isasim")
    write(options.output, "\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
