#!/usr/bin/env python3
"""What dealing tiles by the last frame is worth, where that was the same view, and where the camera has turned since.

usage: dealing.py [--machines NAME...] [--scenes NAME...] [--turns DEGREES...]

Draws two pictures in one process, 960x544, and prints the second one's figures as a Markdown table: with `--deal lists`
in full, with `--deal last-frame` the change. The first picture of the view, which has none before it, has a row of its
own. A camera turns about its own vertical axis. Pictures have the same bits, or the program ends with an error.
"""

import argparse
import math
import os
import sys
import tempfile

import clocked
import command_line
import scenes
import timed_frame
from ideas import BUSY

SCENES = ("guitar", "statue", "truck", "garden_outdoor")
KEYS = (("busy", 1e6, 3), ("blend", 1e6, 3), ("cycles", 1e6, 3), ("joules", 1e-3, 2))


def turned(camera, degrees):
    """The camera, looking so far to its right."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    rotation = [[row[0] * c - row[2] * s, row[1], row[0] * s + row[2] * c] for row in camera["rotation"]]
    return dict(camera, rotation=rotation)


def figures(found):
    time = found["time"]
    return {"picture": found["result_fnv1a64"], "busy": max(sum(one[reason] for reason in BUSY) for one in time["sum"]["rasterizers"]),
            "blend": next(stage["time"]["cycles"] for stage in time["stages"] if stage["name"] == "blend"),
            "machine": clocked.name(time["sum"]), "cycles": time["sum"]["cycles"], "joules": found["energy"]["chip_joules"]["value"]}


def draw(scene, machine, cameras, deal, folder):
    """The figures of both pictures."""
    found = timed_frame.pair(scene, cameras, folder, "--size", "960x544", "--exp", "table", "--energy", "--deal", deal,
                             VORION_CONFIG=machine)
    return [figures(one) for one in found]


def row(name, lists, last):
    if lists["picture"] != last["picture"]:
        sys.exit(f"dealing.py: error: {name}: another picture, expected the same bits")
    changes = [f"{100 * (last[key] / lists[key] - 1):+.1f} %" for key, _, _ in KEYS]
    full = [f"{lists[key] / scale:.{digits}f}" for key, scale, digits in KEYS]
    print(f"| {name} | " + " | ".join(f"{a} | {b}" for a, b in zip(full, changes, strict=True)) + " |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--machines", nargs="+", default=["prototype", "prototype-on-chip", "scaled"])
    parser.add_argument("--scenes", nargs="+", default=SCENES, choices=scenes.known() or None)
    parser.add_argument("--turns", nargs="+", type=float, default=[0, 1, 3, 15])
    args = parser.parse_args()
    print("| view | busiest, Mcycles | | blending, Mcycles | | frame, Mcycles | | chip, mJ | |\n|---|" + "--:|" * 8)
    names = []
    with tempfile.TemporaryDirectory() as folder:
        for machine in args.machines:
            for scene in map(scenes.shared, args.scenes):
                for camera in timed_frame.cameras_of(os.path.join(scenes.ROOT, scene.cameras)):
                    name = f"{scene.name} {camera['img_name']}, `{machine}`"
                    for turn in args.turns:
                        pair = [turned(camera, -turn), camera]
                        lists, last = (draw(scene, machine, pair, deal, folder) for deal in ("lists", "last-frame"))
                        names.append(last[1]["machine"])
                        if turn == args.turns[0]:
                            row(f"{name}: none before it", lists[0], last[0])
                        row(f"{name}: turned by {turn:g} degrees", lists[1], last[1])
    clocked.say(names)


if __name__ == "__main__":
    command_line.run(main)
