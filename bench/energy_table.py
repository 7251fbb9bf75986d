#!/usr/bin/env python3
"""The table of docs/energy.md on what frames take, drawn anew.

usage: energy_table.py [--scenes FOLDER] [--only TEXT]   (prints Markdown; some minutes)
"""

import argparse
import os
import sys
import tempfile

import clocked
import command_line
import timed_frame

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


def draw(scenes, frame, folder):
    file, scene, view, machine, options = frame
    of = argparse.Namespace(scene=os.path.join(scenes, file), cameras=os.path.join(scenes, "cameras", f"{scene}.json"), view=view)
    unit = () if "simt" in options else ("--exp", "table")  # the rasterizer's
    found, error = timed_frame.report(of, folder, *unit, "--energy", *options, VORION_CONFIG=machine)
    if error:
        sys.exit(f"energy_table.py: error: {error}")
    return found


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
    parser.add_argument("--scenes", default=os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "..", "shared", "data", "scenes"))
    parser.add_argument("--only", default="", help="rows that hold this text")
    chosen = parser.parse_args()
    print("| scene, view | machine | frames/s | chip, mJ | all, mJ | chip, W | peak of the chip, W |\n|---|---|--:|--:|--:|--:|--:|")
    names = []
    with tempfile.TemporaryDirectory() as folder:
        for frame in FRAMES:
            if chosen.only in f"{' '.join(frame[:4])} {' '.join(frame[4])}":
                found = draw(chosen.scenes, frame, folder)
                names.append(clocked.name(found["time"]["sum"]))
                print(row(frame, found), flush=True)
    if names:
        clocked.say(names)


if __name__ == "__main__":
    command_line.run(main)
