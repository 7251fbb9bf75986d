#!/usr/bin/env python3
"""Writes the counters for one of those who carry them.

usage: counters.py [--tblgen PATH] --for READER OUTPUT
isasim     CoreCounters and RasterCounters with their sums, and tables of their members
driver     vx_counters of vorion/runtime.h
run        vx_counters made of the simulator's
opencl     the names that clGetEventInfoVORION knows
event      the member of vx_counters for each of these names
splat      KernelCounters of the program `splat`, and the table of its members
"""

from types import SimpleNamespace

from printing import C, Cpp, camel, note
from records import write_for_one_of

C_TYPES = C(u64="uint64_t")


def field(record, prefix=""):
    return SimpleNamespace(Type="u64", Name=prefix + record.Counter, Count=1, Doc=record.Counts)


def all_fields(records):
    """(record, field) of all counters, named as in vx_counters."""
    for r in records.of("CoreCounter"):
        yield r, field(r)
    for r in records.of("RasterCounter"):
        yield r, field(r, "raster_")


def shown_fields(records):
    """Of these, those that OpenCL programs see."""
    return [(r, f) for r, f in all_fields(records) if r.Token]


def token(counter):
    return f"CL_EVENT_{counter.Name.upper()}_VORION"


def cpp(name, *includes):
    yield note("counters.py")
    yield "#pragma once\n"
    yield from (f"#include {i}" for i in includes)
    yield f"\nnamespace {name} {{\n"


def plus(name, fields):
    yield f"  {name} &operator+=(const {name} &Other) {{"
    yield from (f"    {camel(f.Name)} += Other.{camel(f.Name)};" for f in fields)
    yield "    return *this;\n  }"


def minus(name, fields):
    yield f"  {name} operator-(const {name} &Other) const {{"
    yield f"    {name} Rest = *this;"
    yield from (f"    Rest.{camel(f.Name)} -= Other.{camel(f.Name)};" for f in fields)
    yield "    return Rest;\n  }"


def isasim(records):
    yield from cpp("vorion::isasim", "<cstdint>")
    yield "/// A counter of the structure T."
    yield "template <typename T> struct CounterInfo {"
    yield "  const char *Name;\n  const char *Doc;\n  uint64_t T::*Member;\n};\n"
    kinds = (("CoreCounter", "Of one core, or sums over cores.", (plus,)),
             ("RasterCounter", "Work of completed commands, of one agent or all (the vr_n_* CSRs). A failed\n"
              "/// command counts as one, with the work it did before it failed.", (plus, minus)))
    for kind, doc, operators in kinds:
        counters, name = records.of(kind), kind + "s"
        fields = [field(r) for r in counters]
        functions = ["", *(line for o in operators for line in o(name, fields)),
                     f"  bool operator==(const {name} &) const = default;"]
        yield from Cpp().structure(name, doc, fields, initial="0", functions=functions)
        yield "/// In the records' order."
        yield f"inline constexpr CounterInfo<{name}> {kind}Table[] = {{"
        yield from (f'    {{"{f.Name}", "{f.Doc}", &{name}::{camel(f.Name)}}},' for f in fields)
        yield "};\n"
    yield "} // namespace vorion::isasim"


def driver(records):
    yield note("counters.py", "/*", "*/")
    yield "#ifndef VORION_COUNTERS_H\n#define VORION_COUNTERS_H\n\n#include <stdint.h>"
    yield from C_TYPES.structure("vx_counters", "Sums over cores and rasterizers of one run.",
                                 [f for _, f in all_fields(records)])
    yield "\n#endif"


def run(records):
    yield from cpp("vorion", "<vorion/counters.h>", "<vorion/isasim/Counters.h>")
    yield "/// The counters of a run as the driver gives them."
    yield "inline vx_counters toDriver(const isasim::CoreCounters &Core,"
    yield "                            const isasim::RasterCounters &Raster) {"
    yield "  return {"
    for r, f in all_fields(records):
        source = "Core" if f.Name == r.Counter else "Raster"
        yield f"      .{f.Name} = {source}.{camel(r.Counter)},"
    yield "  };\n}\n\n} // namespace vorion"


def opencl(records):
    yield note("counters.py", "/*", "*/")
    yield "#ifndef CL_VORION_COUNTERS_H\n#define CL_VORION_COUNTERS_H\n"
    for r, f in shown_fields(records):
        yield f"#define {token(f)} {r.Token:#x} /* {f.Doc} */"
    yield "\n#endif"


def event(records):
    yield from cpp("vorion", "<CL/cl_vorion.h>", "<vorion/counters.h>")
    yield "/// Null for a name that is no counter's."
    yield "inline uint64_t vx_counters::*counterNamed(cl_uint Name) {"
    yield "  switch (Name) {"
    yield from (f"  case {token(f)}:\n    return &vx_counters::{f.Name};" for _, f in shown_fields(records))
    yield "  default:\n    return nullptr;\n  }\n}\n\n} // namespace vorion"


def splat(records):
    yield from cpp("vorion::splat", "<CL/cl_vorion.h>", "<cstdint>")
    fields = [f for _, f in shown_fields(records)]
    yield from Cpp().structure("KernelCounters", "What a Vorion device counted for one kernel; zeros are counts too.",
                               fields, initial="0", functions=["", *plus("KernelCounters", fields)])
    yield "struct CounterInfo {\n  const char *Name;\n  cl_uint Token; ///< of clGetEventInfoVORION"
    yield "  uint64_t KernelCounters::*Member;\n};"
    yield "inline constexpr CounterInfo KernelCounterTable[] = {"
    yield from (f'    {{"{f.Name}", {token(f)}, &KernelCounters::{camel(f.Name)}}},' for f in fields)
    yield "};\n\n} // namespace vorion::splat"


READERS = {f.__name__: f for f in (isasim, driver, run, opencl, event, splat)}


if __name__ == "__main__":
    write_for_one_of(READERS, __doc__)
