#!/usr/bin/env python3
"""The source lines of a profile in cycles (--profile with the clock on) as a picture.

usage: profile.py PROFILE.txt OUT.svg [--lines N] [--sources FOLDER] [--made LINE]

The N lines with the most cycles, in the order of the profile, each with a bar: its per cent of all cycles by reason. The text
of a line is the profile's; a profile without it takes it from the file of that name in FOLDER. The exit code is 3 for a file
that is no profile in cycles.
"""

import os
import re
import sys

sys.path.append(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
import command_line
import drawing

WIDTH, CODE, BAR, BAR_END = 984, 178, 560, 920  # pixels: the picture's; where the text and the bars begin, and bars end
ROW, LETTERS = 19, 56  # a row's height, and the letters of a line that have room
VISIBLE = 0.5  # pixels of a part of a bar


def fail(file, what):
    drawing.fail(file, what, "the text that --profile writes with the clock on")


def read(file):
    """(machine, reasons, lines); a line is (file, number, text, cycles, per cent by reason)."""
    try:
        with open(file, encoding="utf-8") as f:
            texts = f.read().splitlines()
    except OSError:
        fail(file, "cannot open")
    machine = next((t.removeprefix("# machine: ") for t in texts if t.startswith("# machine: ")), None)
    heads = next((t.split() for t in texts if t.split()[:3] == ["cycles", "%", "issue"]), None)
    if machine is None or heads is None:
        fail(file, "no profile in cycles")
    reasons, lines, of, begins = heads[2:], [], None, False
    for text in texts:
        words = text.split(None, len(heads))
        if words[:2] == ["cycles", "%"]:
            begins, of = True, None
        elif begins and len(words) > len(heads):  # the first row of a part names it
            begins, of = False, words[-1]
        elif begins:
            begins = False
        elif of and len(words) > len(heads) and (found := re.match(r"(\d+)(?:\s\s?(.*))?$", words[-1])):
            shares = {r: float(w) for r, w in zip(reasons, words[2:]) if w != "-"}
            lines.append((of, int(found[1]), found[2] or "", int(words[0]), shares))
    return machine, reasons, lines


def text_of(line, sources):
    """The line's own text, or that of its file in the folder."""
    file, number, text = line[:3]
    path = os.path.join(sources or "", os.path.basename(file))
    if not text and sources and os.path.exists(path):
        with open(path, encoding="utf-8") as f:
            text = f.read().splitlines()[number - 1]
    return drawing.shortened(text.strip(), LETTERS)


def main():
    parser = drawing.parser(__doc__, "profile")
    parser.add_argument("--lines", type=int, default=24)
    parser.add_argument("--sources", help="a folder with the programs' files")
    args = parser.parse_args()
    machine, _, lines = read(args.profile)
    if not lines:
        fail(args.profile, "no line of source in it")
    chosen = set(sorted(range(len(lines)), key=lambda k: -lines[k][3])[:args.lines])
    shown = [line for k, line in enumerate(lines) if k in chosen]
    longest = max(sum(line[4].values()) for line in shown) or 1
    out = drawing.Drawing(WIDTH, "Cycles by source line and reason",
                          f"{machine}; the {len(shown)} lines with the most cycles, % of all cycles of all cores")
    for line in shown:
        file, number, _, cycles, shares = line
        out.text(CODE - 10, out.y + 13, f"{os.path.basename(file)}:{number}", "soft", "end")
        out.text(CODE, out.y + 13, text_of(line, args.sources), "code ink")
        x = BAR
        for reason, share in drawing.stacked(shares):
            wide = share / longest * (BAR_END - BAR)
            if wide >= VISIBLE:
                out.box(x, out.y + 2, wide, ROW - 4, drawing.colour(reason), f"{reason} {share} %")
                out.used.add(reason)
            x += wide
        out.text(x + 6, out.y + 13, f"{sum(shares.values()):.1f} %")
        out.y += ROW
    out.write(args.output, args.made)


if __name__ == "__main__":
    command_line.run(main)
