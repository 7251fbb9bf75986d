#!/usr/bin/env python3
"""Checks the picture of `scene.py one` against the formula.

usage: one.py PICTURE.pfm BACKGROUND
The Gaussian of scale 0.1 at depth 2 before a focal length of 50 has variance
(50 / 2 * 0.1)^2 + 0.3 = 6.55 px^2 around (32, 24).
"""

import math
import struct
import sys

with open(sys.argv[1], "rb") as f:
    assert f.readline() == b"PF\n"
    width, height = map(int, f.readline().split())
    assert float(f.readline()) < 0  # little endian
    values = struct.unpack(f"<{3 * width * height}f", f.read())
background = float(sys.argv[2])
color = [0.5 + 0.28209479177387814 * c for c in (1, 0.5, -0.5)]
worst = drawn = 0
for y in range(height):
    for x in range(width):
        d2 = (x + 0.5 - 32) ** 2 + (y + 0.5 - 24) ** 2
        alpha = 0.5 * math.exp(-0.5 * d2 / 6.55)
        if alpha < 1 / 255:
            alpha = 0
        drawn += alpha > 0
        for c in range(3):
            # Rows of a PFM are from the bottom.
            got = values[3 * ((height - 1 - y) * width + x) + c]
            worst = max(worst, abs(got - (alpha * color[c] + (1 - alpha) * background)))
print(f"{drawn} pixels drawn, largest difference {worst:.2g}")
sys.exit(worst > 2e-6 or drawn == 0)
