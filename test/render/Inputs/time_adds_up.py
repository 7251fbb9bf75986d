"""Checks that every unit's reasons add up to the cycles, stage by stage, and
that kernels add up to their stage."""
import json
import sys

report = json.load(open(sys.argv[1]))["time"]
REASONS = {
    "cores": "issue start fetch operand memory local unit lsu_queue branch divergence "
             "fence raster_full raster_wait barrier ended".split(),
    "rasterizers": "blend clip fetch hazard begin flush drain idle".split(),
}
stages = [s for s in report["stages"] if "time" in s]
assert len(stages) >= 6, len(stages)
for stage in stages:
    time = stage["time"]
    for units, reasons in REASONS.items():
        for unit in time[units]:
            assert sum(unit[r] for r in reasons) == time["cycles"], (stage["name"], units)
    kernels = sum(k["cycles"] for k in stage["kernels"])
    assert kernels == time["cycles"], stage["name"]
frame = sum(s["time"]["cycles"] for s in stages if s["of_the_frame"])
assert frame == report["sum"]["cycles"] > 0
