#!/usr/bin/env python3
"""What a run of several pictures computed once, by its counters and those of each picture alone.

usage: activated_once.py ALL.json ALONE.json...     files of VORION_STATS
"""

import json
import sys


def instructions(file):
    """Warp instructions of each run, by kernel."""
    kernels = {}
    with open(file, encoding="utf-8") as f:
        for run in json.load(f)["runs"]:
            kernels.setdefault(run["name"], []).append(run["total"]["warp_instructions"])
    return kernels


together, *alone = map(instructions, sys.argv[1:])
assert len(together["activate_scene"]) == 1 and not any("activate_scene" in each for each in alone)
projected = [instruction for each in alone for instruction in each["project"]]
assert len(projected) == len(together["project"])
assert all(less < more for less, more in zip(together["project"], projected)), (together["project"], projected)
print(f"{len(alone)} pictures of a scene that is activated once")
