#!/usr/bin/env python3
"""The plots of docs/validation.md, docs/dram.md and docs/energy.md, from the tables of docs/tables/.

usage: plots.py [FOLDER]     (default: docs/images)

FOLDER gets validation-kernels.svg, the errors of whole kernels, validation-dram.svg, bandwidths by pattern, and
energy-published.svg, energies and areas beside published ones.
"""

import argparse
import math
import os
import re
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
sys.path += [os.path.join(ROOT, "bench"), os.path.join(ROOT, "bench", "pictures"), os.path.join(ROOT, "bench", "paper")]
import command_line
import drawing
import writing

MADE = ["bench/timing/plots.py, from the tables of docs/tables/ that scripts/validate.sh prints"]
LEFT, RIGHT, ROW, RADIUS = 150, 718, 17, 4.5  # pixels
LIMIT = 15  # per cent
# (what a table's line before says, column of the error): name and colour of the dots.
KERNELS = {("`vortex-2025`, one warp:", 3): ("vortex-2025, 1 warp", "#0072b2"),
           ("`vortex-2025`, several warps:", 3): ("2 warps", "#56b4e9"),
           ("`vortex-2025`, several warps:", 6): ("4 warps", "#e69f00"),
           ("`vortex-5stage`:", 3): ("vortex-5stage, 1 warp", "#d55e00")}

PUBLISHED = ["bench/timing/plots.py, from the last table of docs/tables/energy.md"]
OURS, THEIRS = "#0072b2", "#e69f00"
FIRST, LAST, DECADES = 470, 862, (-2, 2)  # pixels, and powers of ten at them


def table(document, before, behind=2):
    """The rows of the table whose heads stand so many lines behind this one."""
    with open(os.path.join(ROOT, "docs", "tables", document), encoding="utf-8") as file:
        lines = file.read().splitlines()
    at = lines.index(before) + behind
    rows = []
    while at < len(lines) and lines[at].startswith("|"):
        rows.append([cell.strip().strip("`") for cell in lines[at].strip("|").split("|")])
        at += 1
    return rows[2:]  # behind the heads and the rule


def kernels(file):
    """A row of dots for each kernel: how far our cycles are from the RTL's."""
    errors = {}
    for (before, column), (series, _) in KERNELS.items():
        for row in table("validation.md", before):
            if row[0] != "geometric mean" and row[column]:
                errors.setdefault(row[0], {})[series] = float(row[column].removesuffix(" %"))
    out = drawing.Drawing(760, "Errors of whole kernels, out of sample", "cycles of our core beside Vortex's RTL; the outermost lines are the limit")
    middle, wide = (LEFT + RIGHT) / 2, (RIGHT - LEFT) / 2 / LIMIT
    bottom = out.y + ROW * len(errors)
    for percent in range(-LIMIT, LIMIT + 1, 5):
        x = middle + percent * wide
        out.elements.append(f'<line x1="{x:g}" y1="{out.y}" x2="{x:g}" y2="{bottom}" stroke="#8888" stroke-width="{1.5 if percent == 0 else 0.7}"/>')
        out.text(x, bottom + 16, f"{percent:+d} %" if percent else "0", "soft", "middle")
    colours = dict(KERNELS.values())
    for kernel, found in sorted(errors.items()):
        out.text(LEFT - 14, out.y + 12, kernel, anchor="end")
        for series, error in found.items():
            out.elements.append(f'<circle cx="{middle + error * wide:.1f}" cy="{out.y + ROW / 2:g}" r="{RADIUS}" fill="{colours[series]}">'
                                f"<title>{kernel}, {series}: {error:+.1f} %</title></circle>")
        out.y += ROW
    out.y += ROW
    out.write(file, MADE, colours)


def dram(file):
    rows = table("dram.md", "controller, and with queues of 32 bursts:")
    described = writing.chart("DRAM bandwidth by pattern, one channel of LPDDR4-3200", "pattern", "GB/s", [row[0] for row in rows],
                              {"ours": [float(row[1]) for row in rows], "Ramulator": [float(row[2]) for row in rows]}, bars=True)
    with open(file, "w", encoding="utf-8") as out:
        out.write(writing.svg_of(described, MADE))


def published(file):
    """A row for each figure: our interval, by the middle of theirs."""
    out = drawing.Drawing(880, "Energies and areas beside published ones", "ours with the interval that holds 90 %, over the middle of theirs")
    rows = table("energy.md", "| what | node | V | theirs, pJ | ours, pJ | ours by theirs | ours is | theirs from |", 0)
    bottom = out.y + ROW * len(rows)
    scale = (LAST - FIRST) / (DECADES[1] - DECADES[0])

    def place(ratio):
        return FIRST + (math.log10(ratio) - DECADES[0]) * scale

    for decade in range(DECADES[0], DECADES[1] + 1):
        x = place(10.0**decade)
        out.elements.append(f'<line x1="{x:g}" y1="{out.y}" x2="{x:g}" y2="{bottom}" stroke="#8888" stroke-width="{1.5 if decade == 0 else 0.7}"/>')
        out.text(x, bottom + 16, f"{10.0**decade:g}", "soft", "middle")
    for what, node, _, theirs, ours, *_ in rows:
        low, high = (float(end) for end in (theirs.split(" to ") * 2)[:2])
        value, least, most = (float(number) for number in re.fullmatch(r"(\S+) \((\S+)-(\S+)\)", ours).groups())
        middle = math.sqrt(low * high)
        out.text(FIRST - 14, out.y + 12, f"{drawing.shortened(what, 62)}, {node}", anchor="end")
        wide = max(place(high / middle) - place(low / middle), 3)
        out.box(place(1) - wide / 2, out.y + 2, wide, ROW - 4, THEIRS, f"theirs: {theirs}")
        out.box(place(least / middle), out.y + ROW / 2 - 1.5, place(most / middle) - place(least / middle), 3, OURS, f"ours: {ours}")
        out.elements.append(f'<circle cx="{place(value / middle):.1f}" cy="{out.y + ROW / 2:g}" r="{RADIUS}" fill="{OURS}"/>')
        out.y += ROW
    out.y += ROW
    out.write(file, PUBLISHED, {"ours": OURS, "theirs": THEIRS})


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", nargs="?", default=os.path.join(ROOT, "docs", "images"))
    folder = parser.parse_args().folder
    os.makedirs(folder, exist_ok=True)
    kernels(os.path.join(folder, "validation-kernels.svg"))
    dram(os.path.join(folder, "validation-dram.svg"))
    published(os.path.join(folder, "energy-published.svg"))


if __name__ == "__main__":
    command_line.run(main)
