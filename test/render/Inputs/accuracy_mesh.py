#!/usr/bin/env python3
"""Checks a sweep of a mesh's approximations.

usage: accuracy_mesh.py ACCURACY.json
Each point was drawn as its setting says, and both paths have the same errors; 4 sub-pixel bits lose at least 3 dB.
"""

import json
import sys

with open(sys.argv[1], encoding="utf-8") as file:
    points = {p["setting"]: p for p in json.load(file)["points"]}
wrong = 0
for setting, point in points.items():
    drawn = {"subpixel_bits": 8, "depth": "fp32"}
    drawn |= {"subpixel-bits=6": {"subpixel_bits": 6}, "subpixel-bits=4": {"subpixel_bits": 4},
              "mesh-depth=unorm24": {"depth": "unorm24"}, "mesh-depth=unorm16": {"depth": "unorm16"}}.get(setting, {})
    wrong += not drawn.items() <= point["made_by"]["mesh"].items()
    wrong += abs(point["cores_errors"]["psnr_db"] - point["errors"]["psnr_db"]) > 0.5
    wrong += point["has_cost"] != (setting == "default")
wrong += points["default"]["errors"]["psnr_db"] < points["subpixel-bits=4"]["errors"]["psnr_db"] + 3
print(f"{len(points)} points, {wrong} wrong", {name: p["errors"]["psnr_db"] for name, p in points.items()})
