#!/usr/bin/env python3
"""What a perfect prediction of the depth at which each tile is opaque could save: docs/prior-art.md, "Depth speculation".

usage: depth_bound.py [--scenes NAME...] [--scene FILE CAMERAS] [--machines NAME...]

Draws all views at 960x544 and prints a table. An entry of a tile's list that no rasterizer fetches is behind that depth: with
a prediction it would be neither made nor sorted. The bound of a frame charges nothing for the prediction, and takes the
stages that handle entries (`duplicate`, `sort by tile`) for proportional to their number.
"""

import argparse

import clocked
import command_line
import scenes
import study

SCENES = ("guitar", "truck", "garden_outdoor")
OF_ENTRIES = ("duplicate", "sort by tile")


def fetched(report):
    """Of all kernels of the frame."""
    return sum(kernel.get("counters", {}).get("raster_gaussians", 0) for stage in report["stages"] for kernel in stage["kernels"])


def bound(report, unused):
    """The share of the frame that stages of entries would save."""
    stages = {stage["name"]: stage["time"]["cycles"] for stage in report["time"]["stages"] if "time" in stage}
    return unused * sum(stages[name] for name in OF_ENTRIES) / report["time"]["sum"]["cycles"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scenes", nargs="+", default=SCENES, choices=scenes.known() or None)
    parser.add_argument("--scene", nargs=2, metavar=("FILE", "CAMERAS"), help="any other scene instead")
    parser.add_argument("--machines", nargs="+", default=("prototype", "scaled"))
    args = parser.parse_args()
    all_scenes = [scenes.given(*args.scene)] if args.scene else [scenes.shared(name) for name in args.scenes]
    names = []
    print("| view | entries | never fetched, % | " + " | ".join(f"bound of a frame on `{name}`, %" for name in args.machines) + " |")
    print("|---|" + "--:|" * (2 + len(args.machines)))
    for scene in all_scenes:
        for view in scene.views:
            reports = study.reports([study.render(machine, scene, view, "--time", "--size", "960x544", "--exp", "table",
                                                  VORION_CONFIG=machine) for machine in args.machines])
            entries = reports[0]["counts"]["pairs"]
            unused = 1 - fetched(reports[0]) / entries
            cells = [f"{scene.name} {view}", str(entries), f"{100 * unused:.1f}", *(f"{100 * bound(one, unused):.1f}" for one in reports)]
            print("| " + " | ".join(cells) + " |", flush=True)
            names += [clocked.name(one["time"]["sum"]) for one in reports]
    clocked.say(names)


if __name__ == "__main__":
    command_line.run(main)
