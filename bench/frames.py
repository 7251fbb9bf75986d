"""Renders of one view, kept in a folder: what the programs that compare them share."""

import argparse
import array
import json
import math
import os
import subprocess

import kept


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


def render(args, name, options):
    """The JSON of the run called name and its picture's file; a run that is there, made from the same, is not repeated."""
    base = os.path.join(args.out, name)
    inputs = {"scene": os.path.abspath(args.scene), "cameras": os.path.abspath(args.cameras)}
    made_from = kept.origin(inputs, ["--view", args.view, *args.options, *options])
    kept.once([base + ".json", base + ".pfm"], made_from, lambda: subprocess.run(
        ["splat", "render", args.scene, "--cameras", args.cameras, "--view", args.view, "-o", base + ".pfm", "--json",
         base + ".json", *args.options, *options], check=True, stdout=subprocess.DEVNULL))
    with open(base + ".json", encoding="utf-8") as f:
        return json.load(f), base + ".pfm"


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
