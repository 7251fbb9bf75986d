#!/usr/bin/env python3
"""How near blending on many rasterizers comes to what bounds it: docs/ideas.md, "Goals".

usage: blending_bound.py [--config MACHINE] [--set SETTINGS] [--scenes NAME...]

Draws all views of scenes of ../shared/data at 960x544 and prints a table. The bound is the largest of three: all tiles'
cycles over the rasterizers, the cycles of the tile that takes longest, and those of the DRAM's buses. "Dealt by cycles"
is what the rasterizers would take if each tile, the longest first, went to the one that is free first.
"""

import argparse
import heapq
import json
import os
import sys
import tempfile

import scenes
import timed_frame

SCENES = ("guitar", "truck", "garden_outdoor")


def jobs(file):
    """Cycles of each tile."""
    with open(file, encoding="utf-8") as f:
        return [job["end"] - job["begin"] for job in map(json.loads, f) if job["unit"] == "rasterizer"]


def dealt(cycles, rasterizers):
    loads = [0] * rasterizers
    for job in sorted(cycles, reverse=True):
        heapq.heapreplace(loads, loads[0] + job)
    return max(loads)


def measure(args, scene, view, folder):
    args.scene, args.cameras, args.view = scene.path, scene.cameras, view
    tiles = os.path.join(folder, "tiles")
    variables = {"VORION_CONFIG": args.config, "VORION_TILES": tiles, **({"VORION_SET": args.set} if args.set else {})}
    found, error = timed_frame.report(args, folder, "--time", "--size", "960x544", "--exp", "table", **variables)
    if error:
        sys.exit(f"blending_bound.py: error: {error}")
    whole = found["time"]["sum"]
    blend = next(stage["time"] for stage in found["time"]["stages"] if stage["name"] == "blend")
    cycles = jobs(tiles)
    channels = timed_frame.machine(args.config)["timing"]["dram"]["channels"]
    rasterizers = len(whole["rasterizers"])
    bounds = {"share of all tiles": sum(cycles) / rasterizers, "longest tile": max(cycles),
              "DRAM": blend["dram"]["bus_ps"] / channels * whole["clock_mhz"] / 1e6}
    return {"blending": blend["cycles"], "kernels in front": blend["cycles"] - kernel(found, "rasterize"),
            "dealt by cycles": dealt(cycles, rasterizers), **bounds, "bound": max(bounds.values())}


def kernel(found, name):
    return sum(one["cycles"] for stage in found["time"]["stages"] for one in stage.get("kernels", ()) if one["name"] == name)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--config", default="scaled", help="a machine, by its name or its file (default scaled)")
    parser.add_argument("--set", help="settings of the machine, as VORION_SET takes them")
    parser.add_argument("--scenes", nargs="+", default=SCENES, choices=scenes.known() or None)
    args = parser.parse_args()
    print("| view | blending, kcycles | kernels in front of it | rasterizers, dealt by cycles | share of all tiles | longest tile | DRAM "
          "| reached |\n|---|--:|--:|--:|--:|--:|--:|--:|")
    with tempfile.TemporaryDirectory() as folder:
        for scene in map(scenes.shared, args.scenes):
            for view in scene.views:
                one = measure(args, scene, view, folder)
                bound = one.pop("bound")
                print(f"| {scene.name} {view} | " + " | ".join(f"{cycles / 1e3:.0f}" for cycles in one.values())
                      + f" | {100 * bound / one['blending']:.0f} % |", flush=True)


if __name__ == "__main__":
    main()
