#!/usr/bin/env python3
"""Writes what is the rasterizer's of CSRs, counters, constants and descriptors as a C++ header (csrs.py has the table).

usage: raster.py [--tblgen PATH] OUTPUT
"""

import argparse
from types import SimpleNamespace

from printing import Cpp, camel, note
from records import Records, write

HEAD = note("raster.py") + """
#pragma once

#include "core/CsrTable.h"
#include "vorion/isasim/Counters.h"

namespace vorion::raster {

using Counters = isasim::RasterCounters;
using isasim::CsrInfo;
using isasim::WriteRule;

/// Some bits of a CSR.
struct BitField {
  unsigned Low, Width;
  constexpr uint32_t mask() const { return (1U << Width) - 1; }
  constexpr uint32_t get(uint32_t Word) const { return Word >> Low & mask(); }
  constexpr uint32_t put(uint32_t Value) const { return (Value & mask()) << Low; }
};
"""


def descriptor_names(records):
    """Of what the rasterizer reads or writes; a hand-over is the last."""
    front_ends = sorted(records.of("FrontEndUnit"), key=lambda u: u.Value)
    return [*dict.fromkeys(u.Record for u in front_ends), "vx_visibility", "vx_tail_range", "vx_tail"]


def is_raster(records, record):
    """Whether a constant or descriptor is the rasterizer's."""
    return record.Name.startswith("VR_") or record.Name in descriptor_names(records)


def csr_name(csr):
    return camel(csr.Name.removeprefix("vr_"))


def enum_csrs(csrs):
    yield "enum class Csr : uint16_t {"
    for c in csrs:
        yield f"  {csr_name(c)} = {c.Number:#05x}, ///< {c.Doc}"
    yield "};\n"


def structure_name(descriptor):
    return camel(descriptor.Name.removeprefix("vx_"))


def field_name(csr):
    return csr.Name.removeprefix("vr_")


def bank(records):
    words = records.of("BankCsr")
    handed = {f.Name for f in handed_over(records)}
    own = [SimpleNamespace(Type="u32", Name=field_name(c), Count=1, Doc=c.Doc) for c in words
           if field_name(c) not in handed]
    indexed = records.of("IndexedWord")
    own += [SimpleNamespace(Type="u32", Name=w.Word, Count=1, Doc=w.Doc) for w in indexed]
    yield from Cpp().structure("BankWords", "The configuration bank, as written.", own, base="TileWords", initial="0")
    yield "/// The word of the bank that \\p C is, or null."
    yield "constexpr uint32_t BankWords::*bankWord(Csr C) {"
    yield "  switch (C) {"
    yield from (f"  case Csr::{csr_name(c)}:\n    return &BankWords::{csr_name(c)};" for c in words)
    yield "  default:\n    return nullptr;\n  }\n}\n"
    yield "/// The word of the bank with number \\p Index, or null."
    yield "constexpr uint32_t BankWords::*indexedWord(uint32_t Index) {"
    yield "  switch (Index) {"
    yield from (f"  case {w.Name}:\n    return &BankWords::{camel(w.Word)};" for w in indexed)
    yield "  default:\n    return nullptr;\n  }\n}\n"


def counters(records):
    csrs = {c.Name: c for c in records.of("Csr")}
    yield "/// The CSRs of a counter's two words."
    yield "struct CounterWords {\n  Csr Low, High;\n  uint64_t Counters::*Value;\n};"
    yield "inline constexpr CounterWords CounterTable[] = {"
    for c in records.of("RasterCounter"):
        yield f"    {{Csr::{csr_name(c)}, Csr::{csr_name(csrs[c.Name + 'h'])}, &Counters::{camel(c.Counter)}}},"
    yield "};\n"


def fields(csrs, words):
    for owner, of in [(csr_name(c), c.Fields) for c in csrs] + [(camel(w.Word), w.Fields) for w in words]:
        for f in of:
            yield f"inline constexpr BitField {owner}{camel(f.Name)}{{{f.Low}, {f.Width}}}; ///< {f.Doc}"
    yield ""


def handed_over(records):
    """A vx_tail begins with words of the command, under the names of their CSRs."""
    bank_names = {field_name(c) for c in records.of("BankCsr")}
    tail = next(d for d in records.of("Descriptor") if d.Name == "vx_tail")
    return [f for f in tail.Fields if f.Name in bank_names]


def descriptors(records):
    *plain, tail = (next(d for d in records.of("Descriptor") if d.Name == name) for name in descriptor_names(records))
    handed = handed_over(records)
    words = SimpleNamespace(Type="TileWords", Name="rest", Count=1, Doc="of the command")
    for d in plain:
        yield from Cpp().structure(structure_name(d), d.Doc, d.Fields)
    yield from Cpp().structure("TileWords", "The words of a command that are handed over.", handed, initial="0")
    yield from Cpp().structure("Tail", tail.Doc, [words, *tail.Fields[len(handed):]])
    for d in (*plain, tail):
        yield f"static_assert(sizeof({structure_name(d)}) == {4 * sum(f.Count for f in d.Fields)});\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--tblgen", default="llvm-tblgen-19")
    parser.add_argument("output")
    args = parser.parse_args()
    records = Records(args.tblgen)
    csrs = sorted((c for c in records.of("Csr") if c.Extension == "xvorion"), key=lambda c: c.Number)
    constants = Cpp().constants(c for c in records.of("Constant") if is_raster(records, c))
    parts = (enum_csrs(csrs), fields(csrs, records.of("IndexedWord")), counters(records), constants, descriptors(records), bank(records))
    lines = [HEAD, *(line for part in parts for line in part), "} // namespace vorion::raster"]
    write(args.output, "\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
