#!/usr/bin/env python3
"""Writes what the clock measures for one of those who read it. Scripts import it for the names, groups and colours.

usage: clock.py [--tblgen PATH] --for READER OUTPUT
isasim  enumerations of the reasons of cycles, and the units' structures with tables of their counts
splat   enumerations of all counts of a unit, their names, and the groups of the reasons
page    the units with their groups of reasons, for the scripts of pages
"""

import functools
import json
from types import SimpleNamespace

from printing import Cpp, camel, flag, note
from records import Records, write_for_one_of


def units(records):
    """The units in the records' order, each with its groups, reasons and counts."""
    colours, found = {}, []
    for unit in records.of("ClockUnit"):
        reasons = [r for r in records.of("ClockReason") if r.Group.Unit.id == unit.id]
        counts = [c for c in records.of("ClockCount") if c.Unit.id == unit.id]
        keys = [r.Key for r in reasons + counts]
        for r in reasons:
            if colours.setdefault(r.Key, r.Colour) != r.Colour:
                raise ValueError(f"{r.file}: '{r.Key}' is {r.Colour} and {colours[r.Key]}, expected one colour")
        for r in reasons + counts:
            if keys.count(r.Key) > 1:
                raise ValueError(f"{r.file}: '{r.Key}' is twice in {unit.id}, expected once")
        found.append(SimpleNamespace(Name=unit.Name, One=unit.One, Key=unit.Key, Reasons=reasons, Counts=counts,
                                     Groups=[g for g in records.of("ReasonGroup") if g.Unit.id == unit.id]))
    return found


@functools.cache
def stored():
    """The units that have reasons, by their key in reports: what scripts ask."""
    return {u.Key: u for u in units(Records()) if u.Reasons}


def groups_of(unit):
    """The keys of each group's reasons, by its label, in the order of stacked bars."""
    return {g.Label: [r.Key for r in unit.Reasons if r.Group.id == g.id] for g in unit.Groups}


def reasons(key):
    """The reasons of the units of a report, in its order."""
    return [r.Key for r in stored()[key].Reasons]


def busy(key):
    """Of these, those of a unit that has something to do."""
    return [r.Key for r in stored()[key].Reasons if not r.Group.Idle]


def in_group(key, label):
    """Of these, those of one group."""
    return groups_of(stored()[key])[label]


def colours():
    """The colour of each reason, in the order of stacked bars. A key that several units have is one colour."""
    return {r.Key: r.Colour for u in stored().values() for g in u.Groups for r in u.Reasons if r.Group.id == g.id}


def cpp(name, *includes):
    yield note("clock.py")
    yield "#pragma once\n"
    yield from (f"#include {i}" for i in includes)
    yield f"\nnamespace {name} {{\n"


def names(reasons_or_counts):
    return ", ".join(f'"{r.Key}"' for r in reasons_or_counts)


def isasim(records):
    yield from cpp("vorion::isasim", "<array>", "<cstddef>", "<cstdint>", "<string_view>")
    yield "/// A count of the structure T, by its key in reports."
    yield "template <typename T> struct ClockCount {"
    yield "  std::string_view Key;\n  uint64_t T::*Member;\n};"
    yield "/// In the order of reports."
    yield "template <typename T> inline constexpr std::array<ClockCount<T>, 0> ClockCounts{};\n"
    for unit in units(records):
        cycles, functions = [], []
        if unit.Reasons:
            enum = f"{unit.Name}Cycle"
            yield f"/// What a cycle of a {unit.One} went to."
            yield f"enum class {enum} : uint8_t {{"
            yield from (f"  {camel(r.Key)}, ///< it {r.Meaning}" for r in unit.Reasons)
            yield "  Count\n};"
            yield f"constexpr std::string_view name({enum} C) {{"
            yield f"  constexpr std::string_view Names[] = {{{names(unit.Reasons)}}};"
            yield "  return Names[size_t(C)];\n}"
            cycles = [SimpleNamespace(Type=f"std::array<uint64_t, size_t({enum}::Count)>", Name="cycles", Count=1,
                                      Doc="by reason")]
            functions = [f"  using Reason = {enum};"]
        time = f"{unit.Name}Time"
        counts = [SimpleNamespace(Type="u64", Name=c.Key, Count=1, Doc=c.Meaning) for c in unit.Counts]
        # Every member starts as 0.
        yield from Cpp().structure(time, f"Of one {unit.One} in a run.", cycles + counts, initial="{}",
                                   functions=functions)
        if counts:
            yield f"template <> inline constexpr auto ClockCounts<{time}> ="
            yield f"    std::to_array<ClockCount<{time}>>({{"
            yield from (f'        {{"{c.Name}", &{time}::{camel(c.Name)}}},' for c in counts)
            yield "    });\n"
    yield "} // namespace vorion::isasim"


def splat(records):
    yield from cpp("vorion::splat", "<array>", "<cstdint>", "<string_view>")
    yield "/// \\name What is counted for each unit of a kind\n/// @{"
    yield "/// The keys of reports. Where a unit has reasons for its cycles, these come first"
    yield "/// and add up to all cycles."
    yield "template <typename Count> inline constexpr std::array<std::string_view, 0> CountNames{};"
    yield "enum class ReasonGroup : uint8_t {"
    yield from (f"  {g.id}, ///< a {u.One} {g.Label}" for u in units(records) for g in u.Groups)
    yield "};"
    yield "struct ReasonInfo {\n  ReasonGroup Group;\n  bool IsIdle; ///< the unit has nothing to do\n  std::string_view Helps; ///< a key of the configuration: more of it shortens the wait\n};"
    yield "/// Of the reasons of a unit, in the order of its counts."
    yield "template <typename Count> inline constexpr std::array<ReasonInfo, 0> Reasons{};\n"
    for unit in units(records):
        enum, counts = f"{unit.Name}Count", unit.Reasons + unit.Counts
        yield f"enum class {enum} : uint8_t {{"
        yield from (f"  {camel(c.Key)}, ///< {c.Meaning}" for c in counts)
        yield "};"
        yield f"template <> inline constexpr std::array CountNames<{enum}> ="
        yield f"    std::to_array<std::string_view>({{{names(counts)}}});"
        if unit.Reasons:
            yield f"template <> inline constexpr auto Reasons<{enum}> = std::to_array<ReasonInfo>({{"
            yield from (f'    {{ReasonGroup::{r.Group.id}, {flag(r.Group.Idle)}, "{r.Group.Helps}"}},' for r in unit.Reasons)
            yield "});"
        yield ""
    yield "/// @}\n\n} // namespace vorion::splat"


def page(records):
    found = {u.Key: {"label": u.One + "s",
                     "groups": {g.Label: {"reasons": groups_of(u)[g.Label], "colour": g.Colour} for g in u.Groups}}
             for u in units(records) if u.Reasons}
    yield note("clock.py")
    yield "// What a unit did in a cycle: groups of the report's reasons, by what the page calls them."
    yield f"const UNITS = {json.dumps(found, indent=2)};"


READERS = {f.__name__: f for f in (isasim, splat, page)}


if __name__ == "__main__":
    write_for_one_of(READERS, __doc__)
