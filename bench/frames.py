"""Renders of one view, kept in a folder: what the programs that compare them share."""

import argparse
import array
import json
import math
import os

import scenes
import study


def parse_arguments(description):
    """The scene, the view and the folder; unknown arguments become .options, for splat render."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("scene")
    parser.add_argument("--cameras", required=True)
    parser.add_argument("--view", required=True)
    parser.add_argument("--out", required=True, help="folder for the runs")
    parser.add_argument("--json", help="write the table")
    args, args.options = parser.parse_known_args()
    os.makedirs(args.out, exist_ok=True)
    return args


def render(args, runs):
    """The reports of runs, options by name, and their pictures' files by name."""
    of = scenes.with_views(args.scene, args.cameras, (args.view,))
    points = {name: study.render(name, of, args.view, *args.options, *options, keep=(".pfm",)) for name, options in runs.items()}
    found = study.measure(points.values(), args.out)
    return {name: (result["report"], study.file_of(args.out, point, ".pfm"))
            for (name, point), result in zip(points.items(), found, strict=True)}


def floats(picture):
    """The floats of a .pfm file."""
    with open(picture, "rb") as f:
        for _ in range(3):
            f.readline()
        return array.array("f", f.read())


def difference(a, b):
    """The largest absolute difference, and the mean of the squares. Numbers that are not finite are no picture."""
    differences = [abs(x - y) for x, y in zip(a, b, strict=True)]
    if not all(map(math.isfinite, differences)):
        raise SystemExit("error: a picture has values that are no finite numbers, expected a picture")
    return max(differences), sum(d * d for d in differences) / len(differences)


def write_table(args, table):
    """What was found, if --json asks for it, with what made it."""
    if args.json:
        with open(args.json, "w", encoding="utf-8") as f:
            json.dump({"scene": args.scene, "view": args.view, "options": args.options, **table}, f, indent=2)
            f.write("\n")
