#!/usr/bin/env python3
"""Writes the effects of the simulator's instructions as a C++ header.

usage: effects.py [--tblgen PATH] OUTPUT
Exit codes: 0 done, 1 a record contradicts its effects, 2 usage.
"""

import argparse
import sys

from isasim import file_of, syntax
from printing import flag, note
from records import Records, write

HEAD = note("effects.py") + """
#pragma once

#include "core/IsaTables.h"

namespace vorion::isasim {
"""

MOST_USES = 2


def contradiction(insn):
    """What a record's operands and its effects disagree about, or an empty text."""
    has_rd = file_of(syntax(insn), "rd") != "None"
    if has_rd == (insn.Effects.Result.id == "NoResult"):
        return f"has {'an' if has_rd else 'no'} rd, expected effects with{'' if has_rd else 'out'} a result"
    for use in insn.Effects.Uses:
        if file_of(syntax(insn), use.Operand) != "X":
            return f"has no integer {use.Operand}, expected effects that do not use it"
    return ""


def enumeration(name, doc, records, docs):
    yield f"/// {doc}"
    yield f"enum class {name} : uint8_t {{"
    for r in records:
        yield f"  {r.id}," + (f" ///< {r.Doc}" if docs else "")
    yield "};\n"


def use(record):
    return f'{{UsedOperand::{record.Operand.capitalize()}, {flag(record.LastLane)}, "{record.What}"}}'


def table(records):
    classes, effects = records.of("EffectClass"), records.of("Effect")
    yield from enumeration("Definedness", "In which lanes rd is defined.", records.of("Definedness"), True)
    yield from enumeration("EffectClass", "Instructions of the same effects.", classes, False)
    yield "enum class UsedOperand : uint8_t { None, Rs1, Rs2 };\n"
    yield "/// An operand on which an instruction acts, so that it must be defined."
    yield "struct OperandUse {\n  UsedOperand Which = UsedOperand::None;"
    yield "  bool LastLane = false; ///< in the last active lane only, else in every active one"
    yield "  const char *What = nullptr; ///< in words\n};\n"
    yield "/// What an instruction does besides computing rd of each active lane from the\n/// lane's own operands."
    yield "struct Effects {"
    yield "  EffectClass Class;"
    for e in effects:
        yield f"  bool {e.id}; ///< {e.Doc}"
    yield "  Definedness Result;"
    yield f"  OperandUse Uses[{MOST_USES}]; ///< those that exist come first"
    yield "};\n"
    yield "/// Indexed by EffectClass."
    yield "inline constexpr Effects EffectTable[] = {"
    for c in classes:
        has = ", ".join(flag(e.id in [x.id for x in c.Effects]) for e in effects)
        uses = ", ".join(use(u) for u in c.Uses)
        yield f"    {{EffectClass::{c.id}, {has}, Definedness::{c.Result.id}, {{{uses}}}}},"
    yield "};\n"
    yield "/// Indexed by Op."
    yield "inline constexpr EffectClass EffectClassOfOp[NumOps] = {"
    for i in records.of("Instruction"):
        yield f"    EffectClass::{i.Effects.id}, // {i.Mnemonic}"
    yield "};\n"
    yield "constexpr const Effects &effectsOf(Op O) {"
    yield "  return EffectTable[static_cast<unsigned>(EffectClassOfOp[static_cast<unsigned>(O)])];\n}\n"
    yield "} // namespace vorion::isasim"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--tblgen", default="llvm-tblgen-19")
    parser.add_argument("output")
    options = parser.parse_args()
    records = Records(options.tblgen)
    for i in records.of("Instruction"):
        if wrong := contradiction(i):
            sys.exit(f"effects.py: error: intrinsics/{i.file}: {i.Mnemonic} {wrong}; it declares {i.Effects.id}")
    write(options.output, "\n".join([HEAD, *table(records)]) + "\n")


if __name__ == "__main__":
    main()
