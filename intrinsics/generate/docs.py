#!/usr/bin/env python3
"""Writes docs/isa.md, the reference of instructions, CSRs and descriptors, or the tables of docs/tables/clock-reasons.md.

usage: docs.py [--tblgen PATH] [--check] OUTPUT
Of a document with the lines `<!-- clock reasons -->` and `<!-- /clock reasons -->` only what is between them is written.
--check: exit 1 and name the file when OUTPUT is not what would be written.
"""

import argparse
import os
import sys
import textwrap

from clock import units as clock_units
from records import Records, write

HEAD = """# Instructions, CSRs and descriptors

Generated from `intrinsics/*.td` by `intrinsics/generate/docs.py`; do not edit.
[abi.md](abi.md) describes the memory map and the use of these records,
[rasterizer.md](rasterizer.md) the rasterizer.
"""


def table(header, rows):
    lines = ["| " + " | ".join(header) + " |", "|" + "---|" * len(header)]
    lines += ["| " + " | ".join(str(c).replace("|", "\\|") for c in row) + " |" for row in rows]
    return "\n".join(lines) + "\n"


def paragraph(text):
    return textwrap.fill(text, 100, break_long_words=False, break_on_hyphens=False) + "\n"


def simt(records):
    yield "\n## SIMT instructions (XVortex)\n"
    yield paragraph("R-type on custom-0. In OpenCL C and in C, `#include <vorion.h>` declares them as functions. *last* is "
                    "the highest-numbered active lane.")
    rows = []
    for i in records.of("SimtInstruction"):
        operands = ", ".join(x for x in (i.Outs, i.Ins) if x)
        rows.append((f"`{i.Mnemonic} {operands}`", f"`{i.Match & 0xffffffff:08x}/{i.Mask & 0xffffffff:08x}`",
                     i.Divergence, i.Effects.id, i.Doc))
    yield table(("instruction", "match/mask", "result over lanes", "effects", "meaning"), rows)


def effects(records):
    yield "\n## Effects\n"
    yield paragraph("Effects of an instruction other than computing rd of each active lane from the lane's operands. "
                    "Checkers report a used operand that is undefined.")
    rows = []
    for c in records.of("EffectClass"):
        instructions = [f"`{i.Mnemonic}`" for i in records.of("Instruction") if i.Effects.id == c.id]
        uses = ", ".join(f"{u.Operand} of {'the last' if u.LastLane else 'every active'} lane" for u in c.Uses)
        rows.append((c.id, "; ".join(e.Doc for e in c.Effects), "" if c.Result.id == "NoResult" else c.Result.Doc, uses,
                     "all others" if c.id == "LaneWise" else " ".join(instructions)))
    yield table(("class", "effects", "rd is defined", "uses", "instructions"), rows)


def csrs(records):
    yield "\n## CSRs\n"
    yield paragraph("Scope: the unit that has one copy. Write: `none` traps, `lane` writes the copy of each active lane, "
                    "`scalar` writes the value of the last active lane, `push` appends one element per active lane, in "
                    "lane order.")
    rows = []
    for c in sorted(records.of("Csr"), key=lambda c: c.Number):
        fields = "".join(f"<br>bits {f.Low + f.Width - 1}:{f.Low} `{f.Name}`: {f.Doc}" for f in c.Fields)
        rows.append((f"`{c.Name}`", f"0x{c.Number:03x}", c.In.Name, c.Rule.Name, c.Extension, c.Doc + fields))
    yield table(("CSR", "number", "scope", "write", "extension", "meaning"), rows)


def counters(records):
    yield "\n## Counters\n"
    yield paragraph("Counters of the cores, and of the completed commands of Raster Agents, including the work of the pixel "
                    "units. Reports and `vx_counters` contain all; `clGetEventInfoVORION` returns those with a token, "
                    "which has the name of the member of `vx_counters`.")
    rows = []
    for kind, prefix in (("CoreCounter", ""), ("RasterCounter", "raster_")):
        for c in records.of(kind):
            rows.append((f"`{prefix}{c.Counter}`", f"`{c.Name}`" if prefix else "", hex(c.Token) if c.Token else "",
                         c.Counts))
    yield table(("counter", "low word", "OpenCL token", "counts"), rows)


def descriptors(records):
    yield "\n## Descriptors\n"
    for d in records.of("Descriptor"):
        size = 4 * sum(f.Count for f in d.Fields)
        yield f"\n### `{d.Name}` ({size} bytes)\n\n{d.Doc}\n"
        rows, offset = [], 0
        for f in d.Fields:
            rows.append((offset, f"`{f.Name}`", f.Type + (f"[{f.Count}]" if f.Count > 1 else ""), f.Doc))
            offset += 4 * f.Count
        yield table(("offset", "field", "type", "meaning"), rows)


def units(records):
    yield "\n## Units of a rasterizer's lane\n"
    yield paragraph("The units that a CSR field selects. Cycles of a reciprocal unit are those of a pair of lanes. [The "
                    "tables of the clock](tables/timing.md) list the operations of each unit, "
                    "[lane-units.md](lane-units.md) describes it.")
    rows = []
    for kind, field in (("FrontEnd", "`vr_mode.primitive`"), ("Exp", "`vr_options.exp`"), ("Blend", "`vr_options.blend`"),
                        ("Reciprocal", "`vr_backward.reciprocal`")):
        for u in sorted(records.of(kind + "Unit"), key=lambda u: u.Value):
            bound = getattr(u, "MaxRelativeError", "").replace("0x1p", "2^")
            rows.append((field, u.Value, f"`{u.Choice}`", bound, u.Latency, u.Doc.split(": ", 1)[1]))
        reserved = "reserved for `{}`." if kind == "FrontEnd" else "reserved: `{}` in earlier versions."
        rows += ((field, r.Value, "", "", "", reserved.format(r.Choice))
                 for r in records.of(f"Reserved{kind}Number"))
    yield table(("field", "number", "option", "largest relative error", "cycles", "unit"), rows)


def constants(records):
    yield "\n## Constants\n"
    yield table(("name", "value", "meaning"),
                [(f"`{c.Name}`", hex(c.Value) if c.Value > 15 else c.Value, c.Doc) for c in records.of("Constant")])


def base(records):
    rows = {}
    for i in records.of("Instruction"):
        if i.Extension != "xvortex":
            rows.setdefault(i.Extension, []).append(f"`{i.Mnemonic}`")
    yield "\n## Base instructions\n"
    yield table(("extension", "instructions"), [(e, " ".join(names)) for e, names in rows.items()])


BEGIN, END = "<!-- clock reasons -->\n", "<!-- /clock reasons -->\n"


def clock_reasons(records):
    for unit in clock_units(records):
        if unit.Reasons:
            yield table((f"`{unit.Key}`", "group", f"a cycle in which the {unit.One}"),
                        [(f"`{r.Key}`", r.Group.Label, r.Meaning) for r in unit.Reasons])
        else:
            yield f"## {unit.One[0].upper()}{unit.One[1:]}\n"
        if unit.Counts:
            head = f"`{unit.Key}`: count" if unit.Reasons else "count"
            yield table((head, "meaning"), [(f"`{c.Key}`", c.Meaning) for c in unit.Counts])


def page_with_reasons(page, records):
    before, _, rest = page.partition(BEGIN)
    after = rest.partition(END)[2]
    return before + BEGIN + "\n" + "\n".join(clock_reasons(records)) + "\n" + END + after


def text_for(output, records):
    """What the file is to hold."""
    if os.path.exists(output):
        with open(output, encoding="utf-8") as file:
            page = file.read()
        if BEGIN in page:
            return page_with_reasons(page, records)
    parts = (simt, effects, csrs, counters, units, descriptors, constants, base)
    return HEAD + "".join(chunk if chunk.endswith("\n") and chunk.startswith("|") else chunk + "\n"
                          for part in parts for chunk in part(records))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--tblgen", default="llvm-tblgen-19")
    parser.add_argument("--check", action="store_true")
    parser.add_argument("output")
    args = parser.parse_args()
    text = text_for(args.output, Records(args.tblgen))
    if args.check:
        with open(args.output) as current:
            if current.read() == text:
                return 0
        print(f"docs.py: error: {args.output}: stale, expected the output of intrinsics/generate/docs.py",
              file=sys.stderr)
        return 1
    write(args.output, text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
