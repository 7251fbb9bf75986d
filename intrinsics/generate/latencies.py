#!/usr/bin/env python3
"""Writes what the records say an instruction costs, for the compiler or the simulator.

usage: latencies.py [--tblgen PATH] (--scheduling | --clock) OUTPUT

--scheduling  TableGen for LLVM: units, one SchedWriteRes a latency class, and the class of every record's instruction
--clock       a C++ header: the classes with their cycles, and the class of every record
"""

import argparse

from printing import note
from records import Records, write

# Instructions that LLVM calls otherwise than after their mnemonic.
LLVM_NAMES = {"zext.h": "ZEXT_H_RV32", "rev8": "REV8_RV32", "amocas.d": "AMOCAS_D_RV32"}


def llvm_name(record):
    """As a regular expression: an atomic has variants for its ordering."""
    if record.id.startswith("VX_"):
        return record.id
    name = LLVM_NAMES.get(record.Mnemonic, record.Mnemonic.upper().replace(".", "_"))
    return name + "(_AQ|_RL|_AQ_RL)?" if record.Latency.Name == "atomic" else name


def scheduling(records):
    classes = records.of("LatencyClass")
    yield note("latencies.py") + "\n"
    load = next(c for c in classes if c.Name == "load")
    yield f"def VorionModel : VorionPipeline {{ let LoadLatency = {load.Cycles}; }}"
    for c in classes:
        yield f"defvar {c.id}Cycles = {c.Cycles};"
    yield "let SchedModel = VorionModel in {"
    for unit in dict.fromkeys(c.Unit for c in classes):
        yield f"def Vorion{unit.capitalize()} : ProcResource<1>;"
    for c in classes:
        yield (f"def Write{c.id} : SchedWriteRes<[Vorion{c.Unit.capitalize()}]> "
               f"{{ let Latency = {c.Cycles}; let ReleaseAtCycles = [{c.Interval}]; }}")
    for c in classes:
        names = [llvm_name(r) for r in records.of("Instruction") if r.Latency.id == c.id]
        if names:
            expressions = ", ".join(f'"^{name}$"' for name in names)
            yield f"def : InstRW<[Write{c.id}], (instregex {expressions})>;"
    yield "}"


def clock(records):
    classes = records.of("LatencyClass")
    yield note("latencies.py")
    yield "#pragma once\n"
    yield "#include \"core/IsaTables.h\"\n"
    yield "namespace vorion::isasim {\n"
    yield "/// Instructions that cost the same."
    yield "enum class OpClass : uint8_t {"
    for c in classes:
        yield f"  {c.Name.capitalize()}, ///< {c.Source}"
    yield "  Count\n};\n"
    yield "/// Whom an instruction is given to."
    units = list(dict.fromkeys(c.Unit for c in classes))
    yield f"enum class Unit : uint8_t {{ {', '.join(u.capitalize() for u in units)}, Count }};\n"
    yield "/// Cycles until the result can be used, and until the unit takes the next."
    yield "struct LatencyInfo {\n  const char *Name;\n  Unit On;\n  uint8_t Cycles, Interval;\n};"
    yield "/// Indexed by OpClass."
    yield "inline constexpr LatencyInfo LatencyTable[] = {"
    for c in classes:
        yield f'    {{"{c.Name}", Unit::{c.Unit.capitalize()}, {c.Cycles}, {c.Interval}}},'
    yield "};\n"
    yield "/// Indexed by Op."
    yield "inline constexpr OpClass ClassOfOp[NumOps] = {"
    for r in records.of("Instruction"):
        yield f"    OpClass::{r.Latency.Name.capitalize()}, // {r.Mnemonic}"
    yield "};\n"
    yield "} // namespace vorion::isasim"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--tblgen", default="llvm-tblgen-19")
    kind = parser.add_mutually_exclusive_group(required=True)
    kind.add_argument("--scheduling", dest="make", action="store_const", const=scheduling)
    kind.add_argument("--clock", dest="make", action="store_const", const=clock)
    parser.add_argument("output")
    options = parser.parse_args()
    write(options.output, "\n".join(options.make(Records(options.tblgen))) + "\n")


if __name__ == "__main__":
    main()
