#!/usr/bin/env python3
"""Writes the table of all CSRs, those of the Raster Agent among them, as a C++ header.

usage: csrs.py [--tblgen PATH] OUTPUT
"""

import argparse

from printing import camel, flag, note
from records import Records, write

HEAD = note("csrs.py") + """
#pragma once

#include <algorithm>
#include <cstdint>

namespace vorion::isasim {

/// Where one copy of a CSR lives.
enum class Scope : uint8_t { Lane, Warp, Core, Agent, Socket, Cluster, Device };
/// What a write by several active lanes means.
enum class WriteRule : uint8_t { None, Lane, Scalar, Push };

struct CsrInfo {
  uint16_t Number;
  Scope In;
  WriteRule Rule;
  bool Uniform; ///< all lanes read the same value, so one read serves them all
  bool Raster;  ///< the Raster Agent's
  const char *Name;
};
"""

TAIL = """/// The entry of CSR \\p Number, or nullptr.
constexpr const CsrInfo *findCsrInfo(unsigned Number) {
  const CsrInfo *End = CsrTable + NumCsrs;
  const CsrInfo *Found = std::lower_bound(
      CsrTable, End, Number, [](const CsrInfo &C, unsigned N) { return C.Number < N; });
  return Found != End && Found->Number == Number ? Found : nullptr;
}

} // namespace vorion::isasim
"""


def table(records):
    csrs = sorted(records.of("Csr"), key=lambda c: c.Number)
    yield "enum Csr : uint16_t {"
    for c in csrs:
        yield f"  {c.id if c.id.startswith('CSR_') else 'CSR_' + c.id} = {c.Number:#05x},"
    yield "};\n"
    yield "/// By ascending number."
    yield f"inline constexpr unsigned NumCsrs = {len(csrs)};"
    yield "inline constexpr CsrInfo CsrTable[NumCsrs] = {"
    for c in csrs:
        yield (f"    {{{c.Number:#05x}, Scope::{camel(c.In.Name)}, WriteRule::{camel(c.Rule.Name)}, "
               f"{flag(c.Uniform)}, {flag(c.Extension == 'xvorion')}, \"{c.Name}\"}},")
    yield "};\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--tblgen", default="llvm-tblgen-19")
    parser.add_argument("output")
    options = parser.parse_args()
    write(options.output, "\n".join([HEAD, *table(Records(options.tblgen)), TAIL]))


if __name__ == "__main__":
    main()
