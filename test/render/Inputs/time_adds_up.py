"""Checks that every unit's reasons add up to the cycles, stage by stage, and
that kernels add up to their stage."""
import json
import os
import sys

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "..", "intrinsics", "generate"))
import clock

report = json.load(open(sys.argv[1]))["time"]
stages = [s for s in report["stages"] if "time" in s]
assert len(stages) >= 6, len(stages)
for stage in stages:
    time = stage["time"]
    for units in clock.stored():
        assert time[units] or units in ("command_processors", "dma_engines"), units
        for unit in time[units]:
            assert sum(unit[r] for r in clock.reasons(units)) == time["cycles"], (stage["name"], units)
    kernels = sum(k["cycles"] for k in stage["kernels"])
    assert kernels == time["cycles"], stage["name"]
frame = sum(s["time"]["cycles"] for s in stages if s["of_the_frame"])
assert frame == report["sum"]["cycles"] > 0
