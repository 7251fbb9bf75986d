#!/usr/bin/env python3
"""Compares an analysis with renders: same-pairs.py ANALYSIS RENDER..."""

import json
import sys

with open(sys.argv[1]) as f:
    analysis = json.load(f)
for name in sys.argv[2:]:
    with open(name) as f:
        render = json.load(f)
    tile = str(render["options"]["tile"])
    pairs = render["counts"]["pairs"]
    if not pairs or analysis["invocations"][tile] != pairs:
        sys.exit(f"tile {tile}: {analysis['invocations'][tile]} invocations, the device has {pairs}")
    if analysis["invocations"] != analysis["invocations_by_support"][render["support"]]:
        sys.exit("invocations are not those of the chosen support")
    print(f"tile {tile}: {pairs} pairs on both sides")
