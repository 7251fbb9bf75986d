#!/usr/bin/env python3
"""A stretch of a core's instructions (--pipeline) as a picture.

usage: pipeline.py LOG.kanata OUT.svg [--instructions N] [--made LINE]

A row of each of the first N instructions, along the cycles: what it waits for, when it issues, and as a thin bar until when it
executes. Where that lies beyond the last issue, the bar ends at the picture's edge. The exit code is 3 for a file that is no
such log.
"""

import os
import sys

sys.path.append(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
import command_line
import drawing

WIDTH, CODE, LEFT, RIGHT = 984, 178, 430, 968  # pixels: the picture's; where instructions and cycles begin and end
ROW = 17
LETTERS = 38   # of an instruction that have room
BEYOND = 8     # cycles behind the last issue
EXECUTE = "#9aa4af"


def fail(file, what):
    drawing.fail(file, what, "what --pipeline writes")


def read(file):
    """(first cycle, instructions in order); an instruction has a text, a place and its stages: (name, begin, end)."""
    try:
        with open(file, encoding="utf-8") as f:
            lines = [line.rstrip("\n").split("\t") for line in f]
    except (OSError, UnicodeDecodeError):
        fail(file, "cannot be read")
    if lines[:1] != [["Kanata", "0004"]]:
        fail(file, "no log for Konata")
    now, first, found, open_stages = 0, 0, {}, {}
    for kind, *rest in lines[1:]:
        if kind == "C=":
            first = int(rest[0])
        elif kind == "C":
            now += int(rest[0])
        elif kind == "I":
            found[rest[0]] = {"text": "", "place": "", "stages": []}
        elif kind == "L":
            found[rest[0]]["text" if rest[1] == "0" else "place"] = rest[2]
        elif kind == "S":
            open_stages[rest[0], rest[2]] = now
        elif kind == "E":
            found[rest[0]]["stages"].append((rest[2], open_stages.pop((rest[0], rest[2])), now))
    for (number, stage), begin in open_stages.items():
        found[number]["stages"].append((stage, begin, None))
    return first, list(found.values())


def main():
    parser = drawing.parser(__doc__, "log")
    parser.add_argument("--instructions", type=int, default=36)
    args = parser.parse_args()
    first, instructions = read(args.log)
    shown = instructions[:args.instructions]
    last = max((end for i in shown for stage, _, end in i["stages"] if stage == "issue" and end), default=0) + BEYOND
    if not shown:
        fail(args.log, "no instruction in it")
    out = drawing.Drawing(WIDTH, "Pipeline of a core", f"{len(shown)} instructions; {last} cycles from left to right, from cycle {first:,} on")
    wide = (RIGHT - LEFT) / last
    for instruction in shown:
        address, _, text = instruction["text"].partition(" ")
        place = instruction["place"].split(" ")[0] or address
        out.text(CODE - 10, out.y + 12, place, "soft", "end")
        out.text(CODE, out.y + 12, drawing.shortened(text, LETTERS), "code ink")
        for stage, begin, end in instruction["stages"]:
            end = last if end is None else min(end, last)
            if begin >= end:
                continue
            high = ROW - 10 if stage == "execute" else ROW - 3
            fill = EXECUTE if stage == "execute" else drawing.colour(stage)
            out.box(LEFT + begin * wide, out.y + (ROW - high) / 2, (end - begin) * wide, high, fill, f"{stage}: {end - begin} cycles")
            out.used.add(stage)
        out.y += ROW
    legend = {name: drawing.colour(name) for name in drawing.COLOURS if name in out.used}
    out.write(args.output, args.made, legend | {"execute": EXECUTE})


if __name__ == "__main__":
    command_line.run(main)
