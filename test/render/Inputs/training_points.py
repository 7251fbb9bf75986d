#!/usr/bin/env python3
"""Writes made-up points of `splat accuracy --train CAPTURE`, whose names come from its --list on standard input.

usage: training_points.py FOLDER < list
They say that they were made from what the folder's default@gradients was.
"""

import json
import os
import sys

folder, = sys.argv[1:]
UNITS = ["exact", "even-left", "even-best", "log-left", "log-best", "mantissa-2", "mantissa-3"]
with open(os.path.join(folder, "points", "default@gradients.json"), encoding="utf-8") as f:
    made_from = json.load(f)["made_from"]
for number, name in enumerate((line.strip() for line in sys.stdin), 1):
    setting, at = name.split("@")
    point = {"point": name, "made_from": made_from, "setting": setting}
    if at == "gradients":
        point["errors"] = {kind: 10.0 ** -(number + 1) for kind in ("means", "quats", "scales", "opacities", "colors", "largest")}
    else:
        curve = [{"iteration": n, "machine_seconds": 0.01 * n, "psnr8_db": 10 + n / 4 + number / 100} for n in (5, 10, 15, 20)]
        point |= {"seed": at, "psnr8_db": curve[-1]["psnr8_db"], "timed": 2, "clocked_machine": "prototype, 530 MHz, clock version 1", "cycles": 4e6 + 1000.0 * number, "chip_joules": 0.04 + 0.001 * number,
                  "reciprocal_um2": [1000.0 * (n + 1) for n in range(len(UNITS))], "curve": curve,
                  "made_by": {"capture": "</script>"}}
    with open(os.path.join(folder, "points", name + ".json"), "w", encoding="utf-8") as f:
        json.dump(point, f)
