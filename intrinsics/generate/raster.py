#!/usr/bin/env python3
"""Writes the rasterizer's CSR names and fields, constants and record layouts as a C++ header (csrs.py has the table).

usage: raster.py [--tblgen PATH] OUTPUT
"""

import argparse

from records import Records, write

HEAD = """// Generated from intrinsics/*.td by intrinsics/generate/raster.py; do not edit.
#pragma once

#include "core/CsrTable.h"

namespace vorion::raster {

using isasim::CsrInfo;
using isasim::WriteRule;

/// Some bits of a CSR.
struct BitField {
  unsigned Low, Width;
  constexpr std::uint32_t mask() const { return (1U << Width) - 1; }
  constexpr std::uint32_t get(std::uint32_t Word) const { return Word >> Low & mask(); }
  constexpr std::uint32_t put(std::uint32_t Value) const { return (Value & mask()) << Low; }
};
"""


def camel(name):
    return "".join(part.capitalize() for part in name.split("_"))


def enum_csrs(csrs):
    yield "enum class Csr : std::uint16_t {"
    for c in csrs:
        yield f"  {camel(c.Name.removeprefix('vr_'))} = {c.Number:#05x}, ///< {c.Doc}"
    yield "};\n"


def fields(csrs):
    for c in csrs:
        for f in c.Fields:
            name = camel(c.Name.removeprefix("vr_")) + camel(f.Name)
            yield f"inline constexpr BitField {name}{{{f.Low}, {f.Width}}}; ///< {f.Doc}"
    yield ""


def constants(records):
    yield "// The names of the ABI, as in every other language."
    yield "// NOLINTBEGIN(readability-identifier-naming)"
    for c in records.of("Constant"):
        if c.Name.startswith("VR_"):
            yield f"inline constexpr std::uint32_t {c.Name} = {c.Value:#x}; ///< {c.Doc}"
    yield "// NOLINTEND(readability-identifier-naming)\n"


def descriptors(records):
    types = {"f32": "float", "u32": "std::uint32_t"}
    for name, type_name in (("vx_gaussian", "Gaussian"), ("vx_tail", "Tail")):
        record = next(d for d in records.of("Descriptor") if d.Name == name)
        yield f"/// {record.Doc}"
        yield f"struct {type_name} {{"
        for f in record.Fields:
            count = f"[{f.Count}]" if f.Count > 1 else ""
            yield f"  {types[f.Type]} {camel(f.Name)}{count}; ///< {f.Doc}"
        yield "};"
        size = 4 * sum(f.Count for f in record.Fields)
        yield f"static_assert(sizeof({type_name}) == {size});\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--tblgen", default="llvm-tblgen-19")
    parser.add_argument("output")
    args = parser.parse_args()
    records = Records(args.tblgen)
    csrs = sorted((c for c in records.of("Csr") if c.Extension == "xvorion"), key=lambda c: c.Number)
    parts = (enum_csrs(csrs), fields(csrs), constants(records), descriptors(records))
    lines = [HEAD, *(line for part in parts for line in part), "} // namespace vorion::raster"]
    write(args.output, "\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
