#!/usr/bin/env python3
"""A timeline in cycles (--timeline with the clock on) as a picture.

usage: timeline.py TIMELINE.json OUT.svg [--made LINE]

A row of a core, rasterizer or pixel unit is stacked: the share of each reason in the cycles of a column. A row of a cache's
banks, of DRAM's channels is as high as its figure, of 100 %, and that of power of the most that it reaches. The exit code is 3
for a file that is no timeline in cycles.
"""

import collections
import json
import os
import sys

sys.path.append(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
import command_line
import drawing

CYCLES = "1 us = 1 cycle of "  # how a timeline says that it is in cycles
COLUMNS = 168
COLUMN = 5   # pixels
LEFT = 128   # of the rows' names
UNIT, FIGURE, GAP = 26, 20, 4  # heights of rows
FIGURES = "#5b8db8"
SHORT = {"last-level cache": "LLC"}
NAME_PIXELS = 7  # a letter's width, about


def fail(file, what):
    drawing.fail(file, what, "what --timeline writes with the clock on")


def read(file):
    """(machine, names of groups and rows, slices by row, figures by row, the end)"""
    try:
        with open(file, encoding="utf-8") as f:
            timeline = json.load(f)
        events, unit = timeline["traceEvents"], timeline["otherData"]["unit"]
    except (OSError, ValueError, KeyError, TypeError):
        fail(file, "no timeline")
    if not unit.startswith(CYCLES):
        fail(file, "no timeline in cycles")
    groups, names, slices, figures = {}, {}, collections.defaultdict(list), collections.defaultdict(list)
    for e in events:
        if e["ph"] == "M" and e["name"] == "process_name":
            groups[e["pid"]] = e["args"]["name"]
        elif e["ph"] == "M" and e["name"] == "thread_name":
            names[e["pid"], e["tid"]] = e["args"]["name"]
        elif e["ph"] == "X":
            slices[e["pid"], e["tid"]].append(e)
        elif e["ph"] == "C":
            figures[e["pid"], e["name"]].append((e["ts"], e["args"]["value"]))
    end = max((e["ts"] + e["dur"] for of_row in slices.values() for e in of_row), default=0)
    if not end:
        fail(file, "a timeline without runs")
    return unit.removeprefix(CYCLES), groups, names, slices, figures, end


def columns_of(begin, end, last):
    """(column, share of the time from begin to end that lies in it)"""
    wide = last / COLUMNS
    for k in range(int(begin / wide), min(COLUMNS, int(end / wide) + 1)):
        inside = min(end, (k + 1) * wide) - max(begin, k * wide)
        if inside > 0:
            yield k, inside / (end - begin)


def stacks(slices, end):
    """Cycles by reason, for each column."""
    found = [collections.Counter() for _ in range(COLUMNS)]
    for e in slices:
        for k, share in columns_of(e["ts"], e["ts"] + e["dur"], end):
            for reason, cycles in e["args"].items():
                found[k][reason] += share * cycles
    return found


def means(values, end):
    """Of a figure that holds until the next one, its mean in each column."""
    found = [0.0] * COLUMNS
    for (at, value), (until, _) in zip(values, [*values[1:], (end, None)]):
        for k, share in columns_of(at, until, end):
            found[k] += share * (until - at) * value / (end / COLUMNS)
    return found


def area(base, tops, bottoms):
    """The path between two rows of steps, in half pixels."""
    def steps(heights):
        return "".join(f"V{base - height / 2:g}H{x:g}" for height, x in heights)
    if not any(t > b for t, b in zip(tops, bottoms)):
        return ""
    left = [LEFT + COLUMN * k for k in range(COLUMNS + 1)]
    runs_up = [(t, left[k + 1]) for k, t in enumerate(tops) if k + 1 == COLUMNS or tops[k + 1] != t]
    runs_down = [(b, left[k]) for k, b in reversed(list(enumerate(bottoms))) if k == 0 or bottoms[k - 1] != b]
    return f"M{left[0]} {base}" + steps(runs_up) + steps(runs_down) + "Z"


def draw_units(out, name, slices, end):
    found = stacks(slices, end)
    reasons = [r for r, _ in drawing.stacked(sum(found, collections.Counter()))]
    base, below = out.y + UNIT, [0] * COLUMNS
    totals = [sum(column.values()) or 1 for column in found]
    height = [0.0] * COLUMNS
    for reason in reasons:
        height = [h + 2 * UNIT * column[reason] / total for h, column, total in zip(height, found, totals)]
        tops = [round(h) for h in height]
        if path := area(base, tops, below):
            out.path(path, drawing.colour(reason))
            out.used.add(reason)
        below = tops
    out.text(LEFT - 8, out.y + UNIT - 9, name, anchor="end")
    out.y += UNIT + GAP


def draw_figures(out, name, values, end):
    whole = max(value for _, value in values) or 1 if name.endswith("mW") else 100
    tops = [round(2 * FIGURE * mean / whole) for mean in means(values, end)]
    out.box(LEFT, out.y, COLUMNS * COLUMN, FIGURE, "#8883")
    if path := area(out.y + FIGURE, tops, [0] * COLUMNS):
        out.path(path, FIGURES)
    out.text(LEFT - 8, out.y + FIGURE - 6, name, anchor="end")
    out.y += FIGURE + GAP


def main():
    args = drawing.parser(__doc__, "timeline").parse_args()
    machine, groups, names, slices, figures, end = read(args.timeline)
    out = drawing.Drawing(LEFT + COLUMNS * COLUMN + 16, "Timeline",
                          f"{machine}; {end:,} cycles from left to right, a column is {round(end / COLUMNS):,}")
    for pid, group in sorted(groups.items()):
        for row in sorted(key for key in slices if key[0] == pid):
            if all("args" in e for e in slices[row]):
                draw_units(out, names[row], slices[row], end)
                continue
            for n, e in enumerate(slices[row]):
                x, wide = LEFT + e["ts"] / end * COLUMNS * COLUMN, e["dur"] / end * COLUMNS * COLUMN
                out.box(x, out.y, max(wide - 1, 0.5), FIGURE, ("#57606a", "#8b949e")[n % 2], e["name"])
                if len(e["name"]) * NAME_PIXELS < wide:
                    out.elements.append(f'<text x="{x + 5:.1f}" y="{out.y + 14}" fill="#fff">{e["name"]}</text>')
            out.text(LEFT - 8, out.y + 14, group, anchor="end")
            out.y += FIGURE + 2 * GAP
        for row in sorted(key for key in figures if key[0] == pid):
            name = row[1].replace(", % busy", "")
            draw_figures(out, name if group == "power" else f"{SHORT.get(group, group)} {name}", figures[row], end)
    out.write(args.output, args.made)


if __name__ == "__main__":
    command_line.run(main)
