#!/usr/bin/env python3
"""Compares rasterizers' cycles and area of reports with those of the first.

usage: ideas.py NAME...   (reports NAME.json of splat render --energy)
"""

import json
import sys


def figures(name):
    with open(name + ".json", encoding="utf-8") as f:
        report = json.load(f)
    rasterizers = report["time"]["sum"]["rasterizers"]
    return {"drain": sum(r["drain"] for r in rasterizers), "blend": sum(r["blend"] for r in rasterizers),
            "slots": sum(r["lane_slots"] for r in rasterizers), "area": report["energy"]["area"]["chip_um2"]["value"]}


base = figures(sys.argv[1])
for name in sys.argv[2:]:
    words = [f"{key} {'less' if value < base[key] else 'more' if value > base[key] else 'same'}"
             for key, value in figures(name).items()]
    print(name, ", ".join(words))
