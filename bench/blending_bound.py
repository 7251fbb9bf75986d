#!/usr/bin/env python3
"""How near blending on many rasterizers comes to what bounds it: docs/ideas.md, "Goals".

usage: blending_bound.py [--config MACHINE] [--set SETTINGS] [--scenes NAME...] [--deal last-frame]

Draws all views of scenes of ../shared/data at 960x544 and prints a table. The bound is the largest of three: all tiles'
cycles over the rasterizers, the cycles of the tile that takes longest, and those of the DRAM's buses. "Dealt by cycles"
is what the rasterizers would take if each tile, the longest first, went to the one that is free first. With --deal
last-frame each view is drawn twice in one process, and the figures are the second picture's.
"""

import argparse
import json
import os
import tempfile

import clocked
import command_line
import scenes
import study
import timed_frame
from raster_bounds import dealt

SCENES = ("guitar", "truck", "garden_outdoor")


def jobs(file):
    """Cycles of each tile of the last picture."""
    with open(file, encoding="utf-8") as f:
        all_jobs = [job for job in map(json.loads, f) if job["unit"] == "rasterizer"]
    last = max(job["run"] for job in all_jobs)
    return [job["end"] - job["begin"] for job in all_jobs if job["run"] == last]


def draw(args, scene, view, folder, variables):
    """The report of the picture that is measured."""
    options = ("--time", "--size", "960x544", "--exp", "table")
    if args.deal != "lists":
        camera = next(one for one in timed_frame.cameras_of(os.path.join(scenes.ROOT, scene.cameras)) if one["img_name"] == view)
        return timed_frame.pair(scene, [camera, camera], folder, *options, "--deal", args.deal, **variables)[1]
    found, = study.reports([study.render("frame", scene, view, *options, **variables)])
    return found


def measure(args, channels, scene, view, folder):
    """Cycles, by the heads of the table, the largest of the three that bound blending, and the machine's name."""
    tiles = os.path.join(folder, "tiles")
    variables = {"VORION_CONFIG": args.config, "VORION_TILES": tiles, **({"VORION_SET": args.set} if args.set else {})}
    found = draw(args, scene, view, folder, variables)
    whole, stages = found["time"]["sum"], {stage["name"]: stage for stage in found["time"]["stages"]}
    blend, rasterizers, cycles = stages["blend"]["time"], len(whole["rasterizers"]), jobs(tiles)
    rasterize = sum(kernel["cycles"] for kernel in stages["blend"]["kernels"] if kernel["name"] == "rasterize")
    bounds = {"share of all tiles": sum(cycles) / rasterizers, "longest tile": max(cycles),
              "DRAM": blend["dram"]["bus_ps"] / channels * whole["clock_mhz"] / 1e6}
    return {"blending, kcycles": blend["cycles"], "kernels in front of it": blend["cycles"] - rasterize,
            "rasterizers, dealt by cycles": dealt(sorted(cycles, reverse=True), rasterizers), **bounds}, max(bounds.values()), clocked.name(whole)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--config", default="scaled", help="a machine, by its name or its file (default scaled)")
    parser.add_argument("--set", help="settings of the machine, as VORION_SET takes them")
    parser.add_argument("--deal", default="lists", choices=("lists", "last-frame"), help="of splat render (default lists)")
    parser.add_argument("--scenes", nargs="+", default=SCENES, choices=scenes.known() or None)
    args = parser.parse_args()
    channels = timed_frame.machine(args.config)["timing"]["dram"]["channels"]
    names = []
    with tempfile.TemporaryDirectory() as folder:
        for scene in map(scenes.shared, args.scenes):
            for view in scene.views:
                one, bound, name = measure(args, channels, scene, view, folder)
                if not names:
                    print("| view | " + " | ".join(one) + " | reached |\n|---|" + "--:|" * (len(one) + 1))
                print(f"| {scene.name} {view} | " + " | ".join(f"{cycles / 1e3:.0f}" for cycles in one.values())
                      + f" | {100 * bound / one['blending, kcycles']:.0f} % |", flush=True)
                names.append(name)
    clocked.say(names)


if __name__ == "__main__":
    command_line.run(main)
