#!/usr/bin/env python3
"""joined.py EXPLORE.json WEIGHT FIRST.json SECOND.json TRAINED.json: whether the base's figures are those of reports.

FIRST and SECOND are of splat render, the first with that weight and the second with 1; TRAINED is of splat train.
"""

import json
import statistics
import sys

explored, weight, *names = sys.argv[1:]
weights = [float(weight), 1.0]


def read(name):
    with open(name, encoding="utf-8") as file:
        return json.load(file)


base = next(m for m in read(explored)["machines"] if m["machine"] == "base")
*frames, trained = map(read, names)
milliseconds = [w * f["time"]["frame_ms"] for w, f in zip(weights, frames)]
joules = [w * f["energy"]["chip_joules"]["value"] for w, f in zip(weights, frames)]
timed = trained["timed"]
assert len(timed) == 2, len(timed)
expected = {
    "frames_per_second": 1e3 * sum(weights) / sum(milliseconds),
    "chip_joules": sum(joules) / sum(weights),
    "iterations_per_second": 1e3 / statistics.fmean(t["time"]["frame_ms"] for t in timed),
    "iteration_joules": statistics.fmean(t["energy"]["chip_joules"]["value"] for t in timed),
    "chip_mm2": frames[0]["energy"]["area"]["chip_um2"]["value"] / 1e6,
}
figures = base["whole"]
for key, value in expected.items():
    assert abs(figures[key] / value - 1) < 1e-12, (key, figures[key], value)
parts = figures["parts"]
assert [p["part"] for p in parts] == ["s", "dot", "state"], parts
for part, report, ms, j in zip(parts, frames, milliseconds, joules):
    assert abs(part["frames_per_second"] * report["time"]["frame_ms"] / 1e3 - 1) < 1e-12, part
    assert abs(part["time_share"] - ms / sum(milliseconds)) < 1e-12, part
    assert abs(part["energy_share"] - j / sum(joules)) < 1e-12, part
stages = {}
for one in timed:
    for stage in one["time"]["stages"]:
        if stage["of_the_frame"] and "time" in stage:
            stages[stage["name"]] = stages.get(stage["name"], 0) + stage["time"]["cycles"]
found = base["views"][2]
assert {s["name"]: s["cycles"] for s in found["stages"]} == {name: cycles // 2 for name, cycles in stages.items()}, found
print("the base's figures are those of its runs")
