#!/usr/bin/env python3
"""The table of docs/tables/energy-frames.md, drawn again.

usage: energy_table.py [--scenes FOLDER] [--only TEXT]   (prints Markdown; some minutes)
"""

import argparse
import os

import clocked
import command_line
import scenes
import study

FRAMES = [  # scene's file and its name, view, machine, options
    ("guitar.compressed.ply", "guitar", "front", "prototype", ()),
    ("guitar.compressed.ply", "guitar", "close", "prototype", ()),
    ("truck.splat", "truck", "overview", "prototype", ()),
    ("garden_outdoor.sog.d", "garden_outdoor", "path", "prototype", ()),
    ("guitar.compressed.ply", "guitar", "front", "prototype-forwarding", ()),
    ("truck.splat", "truck", "overview", "prototype-forwarding", ()),
    ("truck.splat", "truck", "close", "prototype-forwarding", ()),
    ("garden_outdoor.sog.d", "garden_outdoor", "path", "prototype-forwarding", ()),
    ("guitar.compressed.ply", "guitar", "front", "prototype", ("--clock", "100")),
    ("guitar.compressed.ply", "guitar", "front", "prototype-forwarding", ("--clock", "100")),
    ("guitar.compressed.ply", "guitar", "front", "scaled", ("--voltage", "0.8")),
    ("truck.splat", "truck", "overview", "scaled", ("--voltage", "0.8")),
    ("guitar.compressed.ply", "guitar", "front", "prototype", ("--path", "simt")),
]
OPTION_TEXTS = {(): "", ("--voltage", "0.8"): "", ("--clock", "100"): ", 100 MHz", ("--path", "simt"): ", `--path simt`"}


def point(folder, frame):
    file, scene, view, machine, options = frame
    of = scenes.with_views(os.path.join(folder, file), os.path.join(folder, "cameras", f"{scene}.json"), (view,))
    unit = () if "simt" in options else ("--exp", "table")  # the rasterizer's
    return study.render("-".join((scene, view, machine, *options)), of, view, *unit, "--energy", *options, VORION_CONFIG=machine)


def digits(value):
    return f"{value:.3g}"


def interval(found, scale=1):
    value, low, high = (digits(found[key] * scale) for key in ("value", "low", "high"))
    return f"{value} ({low}-{high})"


def row(frame, report):
    _, scene, view, machine, options = frame
    energy = report["energy"]
    peak = max((stage["chip_watts"] for stage in energy["stages"]), key=lambda watts: watts["value"])
    cells = [f"{scene} {view}{OPTION_TEXTS[options]}", f"`{machine}`", f"{report['time']['fps']:.1f}", interval(energy["chip_joules"], 1000),
             interval(energy["joules"], 1000), interval(energy["chip_watts"]), interval(peak)]
    return f"| {' | '.join(cells)} |"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scenes", default=os.path.join(scenes.ROOT, scenes.SHARED))
    parser.add_argument("--only", default="", help="rows that hold this text")
    chosen = parser.parse_args()
    print("| scene, view | machine | frames/s | chip, mJ | all, mJ | chip, W | peak of the chip, W |\n|---|---|--:|--:|--:|--:|--:|")
    frames = [frame for frame in FRAMES if chosen.only in f"{' '.join(frame[:4])} {' '.join(frame[4])}"]
    found = study.reports([point(chosen.scenes, frame) for frame in frames])
    for frame, report in zip(frames, found, strict=True):
        print(row(frame, report))
    if found:
        clocked.say(clocked.name(report["time"]["sum"]) for report in found)


if __name__ == "__main__":
    command_line.run(main)
