#!/usr/bin/env python3
"""usage: machines.py FOLDER CONFIGS: renders the scene in FOLDER on every machine that has a file in CONFIGS, with one and
with four host threads. Pictures must have the same bits, reports the same time and the machine's name."""

import json
import os
import subprocess
import sys

folder, configs = sys.argv[1:]
pictures = set()
for machine in sorted(name.removesuffix(".json") for name in os.listdir(configs) if name.endswith(".json")):
    times = []
    for threads in (1, 4):
        picture, report = (os.path.join(folder, f"{machine}-{threads}.{end}") for end in ("pfm", "json"))
        environment = dict(os.environ, VORION_CONFIG=machine, VORION_SET=f"host_threads={threads}")
        subprocess.run(["splat", "render", os.path.join(folder, "s.ply"), "--cameras", os.path.join(folder, "c.json"), "--view",
                        "front", "--time", "--json", report, "-o", picture], check=True, env=environment, stdout=subprocess.DEVNULL)
        with open(picture, "rb") as file:
            pictures.add(file.read())
        with open(report, encoding="utf-8") as file:
            times.append(json.load(file)["time"])
    assert times[0] == times[1], f"{machine}: host threads change the time"
    assert times[0]["sum"]["machine"] == machine, times[0]["sum"]["machine"]
    print(f"{machine}: {times[0]['sum']['cycles']} cycles")
assert len(pictures) == 1, "machines change the picture"
