#!/usr/bin/env python3
"""explored.py EXPLORE.json MACHINE=RENDER.json ...: whether the machine's figures are those of splat render's report."""

import json
import sys

with open(sys.argv[1], encoding="utf-8") as file:
    machines = {m["machine"]: m for m in json.load(file)["machines"]}
for pair in sys.argv[2:]:
    name, path = pair.rsplit("=", 1)
    with open(path, encoding="utf-8") as file:
        report = json.load(file)
    machine = machines[name]
    expected = {"frames_per_second": 1e3 / report["time"]["frame_ms"], "chip_joules": report["energy"]["chip_joules"]["value"],
                "chip_mm2": report["energy"]["area"]["chip_um2"]["value"] / 1e6}
    assert all(abs(machine["whole"][key] / value - 1) < 1e-12 for key, value in expected.items()), (name, machine["whole"], expected)
    clock = report["time"]["sum"]
    assert machine["views"][0]["clocked_machine"] == f"{clock['machine']}, {clock['clock_mhz']} MHz, clock version {clock['clock_version']}", name
    assert machine["views"][0]["picture"] == report["result_fnv1a64"], name
    stages = {s["name"]: s["time"]["cycles"] for s in report["time"]["stages"] if s["of_the_frame"] and "time" in s}
    assert {s["name"]: s["cycles"] for s in machine["views"][0]["stages"]} == stages, name
print(f"{len(sys.argv) - 2} machines are the same")
