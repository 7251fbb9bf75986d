#!/usr/bin/env python3
"""A picture of a view through each camera model, side by side: docs/images/cameras.png.

usage: bench/camera_sheet.py SCENE --cameras FILE --view NAME -o SHEET.png

Draws the view as a pinhole, and from the same place and in the same direction through each model. Lenses and motion are
stronger than those of bench/cameras.py, so that they are seen. Prints what is where.
"""

import argparse
import json
import os
import struct
import subprocess
import sys
import tempfile

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, "test", "Inputs"))
import command_line
import png_file
from cameras import FISHEYE

WIDTH, HEIGHT, COLUMNS, GAP = 180, 135, 4, 4
BARREL = {"camera_model": "OPENCV", "k1": -0.3, "k2": 0.06, "p1": 0.002, "p2": -0.001}
ROLLING = {"rolling_shutter": "ROLLING_TOP_TO_BOTTOM", "rolling_motion": [0.3, 0, 0], "rolling_turn": [0, 0.25, 0]}


def models(view):
    """Name, what the record has, options. Lenses see more than the pinhole."""
    distance = sum(p * p for p in view["position"]) ** 0.5

    def times(factor):
        return {"fx": factor * view["fx"], "fy": factor * view["fy"]}

    fisheye = {**FISHEYE, **times(0.4)}
    return (("pinhole", {}, []), ("OpenCV's distortion", {**BARREL, **times(0.6)}, []),
            ("OpenCV's fisheye", fisheye, []),
            ("orthographic", {"camera_model": "ORTHOGRAPHIC", **times(1 / distance)}, []),
            ("equirectangular", {"camera_model": "EQUIRECTANGULAR"}, []), ("pinhole, rolling shutter", ROLLING, []),
            ("fisheye, unscented", fisheye, ["--projection", "unscented"]),
            ("fisheye, rolling shutter", {**fisheye, **ROLLING, "rolling_turn": [0, 0.8, 0]}, []))


def pixels(path):
    """Rows of a PFM, from the top, in 8 bits."""
    with open(path, "rb") as f:
        data = f.read()
    body = len(data) - 12 * WIDTH * HEIGHT
    values = struct.unpack(f"<{3 * WIDTH * HEIGHT}f", data[body:])
    levels = bytes(max(0, min(255, round(255 * v))) for v in values)
    return [levels[3 * WIDTH * y:3 * WIDTH * (y + 1)] for y in reversed(range(HEIGHT))]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene")
    parser.add_argument("--cameras", required=True)
    parser.add_argument("--view", required=True)
    parser.add_argument("-o", "--output", required=True)
    args, _ = command_line.parse(parser)
    with open(args.cameras, encoding="utf-8") as f:
        view = next(record for record in json.load(f) if record["img_name"] == args.view)
    factor = WIDTH / view["width"]
    view.update(width=WIDTH, height=HEIGHT, fx=view["fx"] * factor, fy=view["fy"] * factor, cx=WIDTH / 2, cy=HEIGHT / 2)
    sheet = []
    with tempfile.TemporaryDirectory() as folder:
        cameras, picture = os.path.join(folder, "c.json"), os.path.join(folder, "p.pfm")
        chosen = models(view)
        for first in range(0, len(chosen), COLUMNS):
            row = [b""] * HEIGHT
            for column, (name, lens, options) in enumerate(chosen[first:first + COLUMNS]):
                with open(cameras, "w", encoding="utf-8") as f:
                    json.dump([{**view, **lens}], f)
                subprocess.run(["splat", "render", args.scene, "--cameras", cameras, "-o", picture, *options],
                               check=True, stdout=subprocess.DEVNULL)
                gap = b"\xff" * (3 * GAP if column else 0)
                row = [a + gap + b for a, b in zip(row, pixels(picture))]
                print(f"row {1 + first // COLUMNS}, column {1 + column}: {name}")
            sheet += [b"\xff" * len(row[0])] * (GAP if first else 0) + row
    png_file.write(args.output, sheet, 3)


if __name__ == "__main__":
    command_line.run(main)
