#!/usr/bin/env python3
"""Writes a capture of two views beside the first of INRIA's cameras, by a lens; its photographs are to come.

usage: over.py CAMERAS.json FOLDER
"""

import json
import os
import sys

CAMERAS, FOLDER = sys.argv[1:]
WIDTH, HEIGHT = 240, 160
with open(CAMERAS, encoding="utf-8") as f:
    view = json.load(f)[0]
axes, (x, y, z) = view["rotation"], view["position"]
frames = []
for name, step in (("a", 0), ("b", 0.1)):
    at = (x + step, y, z)
    frames.append({"file_path": name, "transform_matrix": [
        [axes[i][0], -axes[i][1], -axes[i][2], at[i]] for i in range(3)] + [[0, 0, 0, 1]]})
os.makedirs(FOLDER)
with open(os.path.join(FOLDER, "transforms.json"), "w", encoding="utf-8") as f:
    json.dump({"fl_x": 190, "fl_y": 195, "cx": 118, "cy": 83, "w": WIDTH, "h": HEIGHT,
               "k1": -0.2, "k2": 0.05, "p1": 0.003, "p2": -0.002, "frames": frames}, f)
