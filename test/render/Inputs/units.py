#!/usr/bin/env python3
"""Checks the pictures of units.sh: how far each is from the default, and what it saved."""

import json
import subprocess

BETWEEN = {  # dB: nearer would be no choice, farther a mistake
    "table64": (85, 130), "poly2": (50, 90), "poly3": (75, 120), "poly4": (95, 150),
    "bf16": (40, 75), "fp16": (60, 95), "alpha8": (25, 60), "sh0": (5, 60)}


def counter(name, key):
    with open(name + ".json", encoding="utf-8") as f:
        return json.load(f)["total"]["counters"][key]


for name, (least, most) in BETWEEN.items():
    subprocess.run(["splat", "compare", "default.pfm", name + ".pfm", "--json", "c.json.out"], check=True,
                   stdout=subprocess.DEVNULL)
    with open("c.json.out", encoding="utf-8") as f:
        db = json.load(f)["psnr_db"]
    assert least < db < most, f"{name}: {db} dB, expected {least} to {most}"
assert counter("alpha8", "raster_blends") < counter("default", "raster_blends")
assert counter("alpha8", "raster_fragments") < counter("default", "raster_fragments")
for name in "depth24", "sh0":
    assert counter(name, "warp_instructions") < counter("default", "warp_instructions"), name
