#!/usr/bin/env python3
"""whole_rows.py TIMELINE.svg: whether the parts of each core's row, added up, are as high as the row in every column."""

import collections
import re
import sys

UNIT = 26  # a row's height

with open(sys.argv[1], encoding="utf-8") as file:
    lines = file.read().splitlines()
heights, rows = collections.Counter(), 0
for line in lines:
    if found := re.search(r'<path d="M(\d+) (\d+)(.*)Z"', line):
        base = float(found[2])
        x, steps = float(found[1]), re.findall(r"V([-\d.]+)H([-\d.]+)", found[3])
        for y, to in steps:  # the upper boundary goes right, the lower one back; both are heights over the base
            for column in range(int(min(x, float(to))), int(max(x, float(to)))):
                heights[column] += (base - float(y)) * (1 if float(to) > x else -1)
            x = float(to)
    elif re.search(r">core \d+</text>", line):
        assert heights and all(abs(h - UNIT) < 1e-6 for h in heights.values()), (line, set(heights.values()))
        heights, rows = collections.Counter(), rows + 1
    elif "</text>" in line:
        heights.clear()
print(f"{rows} rows are whole")
