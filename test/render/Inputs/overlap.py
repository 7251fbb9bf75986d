"""Checks what a sequence's reports say of overlapping: APART.json OVERLAPPED.json."""
import json
import os
import sys

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "..", "intrinsics", "generate"))
import clock

apart, beside = (json.load(open(f))["time"] for f in sys.argv[1:])
for report in apart, beside:
    assert report["pictures"] == len(report["latency_ms"]) == 3
    # Sums over stages, which may round otherwise.
    assert report["bound_ms"] <= report["kernel_ms"] <= report["total_ms"] * (1 + 1e-9)
    for units in clock.stored():
        for unit in report["sum"][units]:
            spent = sum(unit[reason] for reason in clock.reasons(units))
            assert spent == report["sum"]["cycles"], (units, spent)
# The rasterizers' work does not change with what else runs, but for memory.
assert abs(beside["rasterizer_busy_ms"] / apart["rasterizer_busy_ms"] - 1) < 0.2
working = lambda r, names: sum(s["time"]["cycles"] - s["time"]["rasterizers"][0]["idle"]
                               for s in r["stages"] if s["name"] in names)
BEFORE = "project", "sort by depth", "count pairs", "duplicate", "sort by tile"
assert working(apart, BEFORE) == 0
assert working(beside, BEFORE) > 0
assert beside["beside_ms"] > apart["beside_ms"]
assert beside["total_ms"] < apart["total_ms"]
