#!/usr/bin/env python3
"""Writes the units of a rasterizer's lane for one of those who know them.

usage: units.py [--tblgen PATH] --for READER OUTPUT
raster  each kind's number and bounds, by number; the reciprocals as an enumeration
clock   time and parts of each unit, by number
splat   enumerations with the units' numbers and names, and what the cores' path is compiled with
"""

from printing import camel, note
from records import write_for_one_of

KINDS = ("FrontEnd", "Exp", "Blend", "Reciprocal")
# In the order of DatapathUnit.
PARTS = ("Latency", "Interval", "Multipliers", "Adders", "ProductBits", "AdderBits", "TableBits", "Source",
         "ChoiceBits", "RegisterBits")


def units(records, kind):
    """In the records' order, that of command lines. With the reserved numbers, theirs are 0 to the last one."""
    found = records.of(kind + "Unit")
    numbers = sorted(u.Value for u in found + records.of(f"Reserved{kind}Number"))
    assert numbers == list(range(len(numbers))), f"numbers of {kind}Unit are not 0, 1, ..., each once"
    return found


def by_number(records, kind):
    return sorted(units(records, kind), key=lambda u: u.Value)


def enumerator(unit):
    return camel(unit.Choice.replace("-", "_"))


def cpp(name, *includes):
    yield note("units.py")
    yield "#pragma once\n"
    yield from (i and f"#include {i}" for i in includes)
    yield f"\nnamespace {name} {{\n"


def raster(records):
    yield from cpp("vorion::raster", '"raster/RasterTables.h"', "", "<cstddef>", "<cstdint>", "<string_view>")
    about = (("Exp", "Report", "double", "MaxRelativeError", "for results of at least 2^-125"),
             ("Blend", "Choice", "unsigned", "SignificandBits", "of a multiplication's operands"),
             ("Reciprocal", "Report", "double", "MaxRelativeError", "over alpha in [1/255, 0.99], rounding included"))
    for kind, name, kind_of_bound, bound, doc in about:
        all_units = by_number(records, kind)
        yield f"struct {kind}Unit {{\n  uint32_t Option; ///< its number\n  std::string_view Name;"
        yield f"  {kind_of_bound} {bound}; ///< {doc}\n}};"
        yield f"inline constexpr std::size_t {kind}UnitCount = {len(all_units)};"
        yield "/// By number; any other is VR_BAD_MODE."
        yield f"inline constexpr {kind}Unit {kind}Units[{kind}UnitCount] = {{"
        for u in all_units:
            yield f'    {{{u.Name}, "{getattr(u, name)}", {getattr(u, bound)}}},'
        yield "};\n"
    yield "enum class Reciprocal : uint8_t {"
    yield from (f"  {enumerator(u)} = {u.Value}, ///< {u.Doc}" for u in by_number(records, "Reciprocal"))
    yield "};\n"
    front_ends = by_number(records, "FrontEnd")
    yield "struct FrontEnd {\n  uint32_t Primitive; ///< its number\n  std::string_view Name;"
    yield "  uint8_t RecordBytes;\n  bool IsOpaque;       ///< a pixel has the nearest, and blends nothing"
    yield "  uint8_t PixelWords;  ///< of the pixel buffer, in a render"
    yield "  uint8_t OutputBytes; ///< of a pixel at vr_output\n};"
    yield "/// By number; any other is VR_BAD_MODE."
    yield f"inline constexpr FrontEnd FrontEnds[{len(front_ends)}] = {{"
    for u in front_ends:
        record = camel(u.Record.removeprefix("vx_"))
        is_opaque = "true" if u.IsOpaque else "false"
        yield f'    {{{u.Name}, "{u.Choice}", sizeof({record}), {is_opaque}, {u.PixelWords}, {4 * u.OutputWords}}},'
    yield "};\n\n} // namespace vorion::raster"


def clock(records):
    yield from cpp("vorion::isasim", '"raster/UnitTables.h"', '"timing/common/DatapathUnits.h"')
    for kind in KINDS:
        yield f"inline constexpr DatapathUnit {kind}Parts[] = {{"
        for u in by_number(records, kind):
            parts = ((part, getattr(u, part)) for part in PARTS)
            yield f'    {{.Name = "{u.Report}",'
            yield from (f'     .{part} = "{value}",' if part == "Source" else f"     .{part} = {value},"
                        for part, value in parts)
            yield "    },"
        yield "};\n"
    yield "} // namespace vorion::isasim"


def function(kind, name, doc, field, all_units):
    values = {u.Value: getattr(u, field) for u in all_units}
    is_text = isinstance(values[0], str)
    yield f"/// {doc}"
    yield f"constexpr {'std::string_view' if is_text else 'unsigned'} {name}({kind} Unit) {{"
    yield "  switch (Unit) {"
    for u in all_units:
        value = values[u.Value]
        yield f"  case {kind}::{enumerator(u)}:\n    return " + (f'"{value}";' if is_text else f"{value};")
    yield "  }\n  return {};\n}\n"


def splat(records):
    yield from cpp("vorion::splat", "<array>", "<cstdint>", "<string_view>")
    for kind, name, doc in (("Exp", "ExpUnit", "The lane's exponential unit, by vr_options.exp."),
                            ("Blend", "BlendUnit", "The lane's blend arithmetic, by vr_options.blend."),
                            ("Reciprocal", "Reciprocal",
                             "The rasterizer's unit for 1 / (1 - alpha), by vr_backward.reciprocal.")):
        all_units = units(records, kind)
        yield f"/// {doc}"
        yield f"enum class {name} : uint8_t {{"
        yield from (f"  {enumerator(u)} = {u.Value}, ///< {u.Doc}" for u in all_units)
        yield "};"
        yield "/// In the order in which command lines show them."
        yield f"inline constexpr std::array {name}s{{"
        yield ",\n".join(f"    {name}::{enumerator(u)}" for u in all_units)
        yield "};"
        yield from function(name, "name", "As on command lines.", "Choice", all_units)
    exps = units(records, "Exp")
    yield from function("ExpUnit", "kernelOf", "The kernels' file that the cores' path takes it from; empty where it "
                        "has none.", "Kernel", exps)
    yield from function("ExpUnit", "kernelDegree", "EXP_DEGREE of that file; 0 where it has none.", "KernelDegree", exps)
    yield from function("BlendUnit", "significandBits", "Of a multiplication's operands.", "SignificandBits",
                        units(records, "Blend"))
    yield "} // namespace vorion::splat"


READERS = {f.__name__: f for f in (raster, clock, splat)}


if __name__ == "__main__":
    write_for_one_of(READERS, __doc__)
