#!/usr/bin/env python3
"""Compares `splat analyze` with the counts that others measured of the private scenes' views.

usage: facts.py DATA SCENE VIEW FOLDER
FACTS.md's lists are by the box of three sigma, INRIA's near plane, its blending not cut at the box.
"""

import glob
import json
import os
import subprocess
import sys

data, scene, view, folder = sys.argv[1:]
rows = {}
with open(os.path.join(data, "scenes/cameras/FACTS.md")) as f:
    for line in f:
        cells = [c.strip().replace(",", "") for c in line.strip().strip("|").split("|")]
        if cells[:2] == [scene, view]:
            rows[len(cells)] = cells
counts, blending = rows[12], rows[11]
path = sorted(glob.glob(os.path.join(data, "scenes", scene + ".*")))[0]


def analyze(support):
    out = os.path.join(folder, f"{scene}-{support}.json")
    subprocess.run(["splat", "analyze", path, "--no-antialiased", "--cameras", os.path.join(data, "scenes/cameras", scene + ".json"),
                    "--view", view, "--support", support, "--json", out], check=True, stdout=subprocess.DEVNULL)
    with open(out) as f:
        return json.load(f)


box, exact = analyze("box3"), analyze("exact")
checks = [  # name, ours, theirs, relative tolerance, absolute: half of the last digit that they print
    ("Gaussians", box["scene"]["gaussians"], float(counts[2]), 0, 0),
    ("in frustum", box["visible"], float(counts[3]), 1e-3, 2),
    ("16: mean", box["lists"]["16"]["mean"], float(counts[7]), 1e-3, 0.06),
    ("16: most", box["lists"]["16"]["max"], float(counts[8]), 2e-3, 2),
    ("16: empty", box["lists"]["16"]["empty"], float(counts[9]), 1e-2, 2),
    ("64: mean", box["lists"]["64"]["mean"], float(counts[10]), 1e-3, 0.06),
    ("64: most", box["lists"]["64"]["max"], float(counts[11]), 2e-3, 2),
    # Their lists' boxes hide a little of what the exact support blends.
    ("blends per pixel", exact["blends_per_pixel"], float(blending[2]), 2e-2, 0.01),
    ("covered", exact["covered_share"], float(blending[5]), 2e-2, 0.002),
    ("mean T", exact["mean_transmittance"], float(blending[6]), 2e-2, 0.002),
    ("saturated", exact["saturated_share"], float(blending[10]), 5e-2, 0.002),
]
bad = 0
for name, ours, theirs, relative, absolute in checks:
    ok = abs(ours - theirs) <= absolute + relative * theirs
    bad += not ok
    print(f"{scene} {view}: {name}: ours {ours:.6g}, theirs {theirs:.6g}{'' if ok else ' DIFFERENT'}")
sys.exit(bad != 0)
