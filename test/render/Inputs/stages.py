"""Checks that one stage of the rasterizers has by far the largest mean error of its own: stages.py REPORT STAGE."""
import json
import sys

with open(sys.argv[1]) as text:
    units = json.load(text)["rasterizers"]
assert units["commands"] > 0 and units["tails"] > 0 and units["not_replayed"] == 0, units["not_replayed"]
stages = {stage["stage"]: stage for stage in units["stages"]}
worst = stages.pop(sys.argv[2])["own_mean"]
assert worst > 10 * max(stage["own_mean"] for stage in stages.values()), (worst, stages)
