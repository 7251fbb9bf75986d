#!/usr/bin/env python3
"""What each camera model costs beside the pinhole, as the tables of docs/tables/cameras.md.

usage: bench/cameras.py SCENE --cameras FILE --view NAME [-- OPTIONS of splat render]

Draws the view as a pinhole, and from the same place and in the same direction through each model, at the same size.
Cycles are of the default machine's clock: of the stage `project`, which alone knows of the camera, and of the frame,
which also draws another part of the scene. One process a picture.
"""

import argparse
import json
import math
import os
import subprocess
import tempfile

import clocked
import command_line
import scenes
import study

# Ordinary lenses: a wide camera's distortion as calibrations find it, and all that the model has.
DISTORTED = {"camera_model": "OPENCV", "k1": -0.12, "k2": 0.03, "p1": 0.0008, "p2": -0.0005}
FISHEYE = {"camera_model": "OPENCV_FISHEYE", "k1": -0.02, "k2": 0.003, "k3": -0.0004, "k4": 0.0001}

# A camera held in a hand that walks: 3 degrees and a little of the way in one exposure.
ROLLING = {"rolling_shutter": "ROLLING_TOP_TO_BOTTOM", "rolling_motion": [0.02, 0, 0.03], "rolling_turn": [0.01, 0.05, 0.01]}


def models(view, centre):
    """Name, what the record has, options."""
    distance = math.dist(view["position"], centre)
    parallel = {"camera_model": "ORTHOGRAPHIC", "fx": view["fx"] / distance, "fy": view["fy"] / distance}
    return (("pinhole", {}, []), ("OpenCV's distortion", DISTORTED, []), ("OpenCV's fisheye", FISHEYE, []),
            ("orthographic", parallel, []), ("equirectangular", {"camera_model": "EQUIRECTANGULAR"}, []),
            ("pinhole, unscented", {}, ["--projection", "unscented"]),
            ("fisheye, unscented", FISHEYE, ["--projection", "unscented"]),
            ("pinhole, rolling shutter", ROLLING, []), ("fisheye, rolling shutter", {**FISHEYE, **ROLLING}, []))


def point(args, number, record, options, folder):
    cameras = os.path.join(folder, f"{number}.json")
    with open(cameras, "w", encoding="utf-8") as f:
        json.dump([record], f)
    of = scenes.with_views(args.scene, cameras, (args.view,))
    return study.render(str(number), of, args.view, "--time", *options, *args.options)


def figures(report):
    project = next(stage for stage in report["time"]["stages"] if stage["name"] == "project")
    return {"project": project["time"]["cycles"], "frame": report["time"]["sum"]["cycles"],
            "seen": report["counts"]["visible"], "pairs": report["counts"]["pairs"], "clock": report["time"]["sum"]}


def row(name, found, first):
    def more(key):
        return f"{100 * found[key] / first[key] - 100:+.1f} %"

    return (f"| {name} | {found['seen']:,} | {found['pairs']:,} | {found['project']:,} | {more('project')} | "
            f"{found['frame']:,} | {more('frame')} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene")
    parser.add_argument("--cameras", required=True)
    parser.add_argument("--view", required=True)
    args, args.options = command_line.parse(parser)
    with open(args.cameras, encoding="utf-8") as f:
        view = next(record for record in json.load(f) if record["img_name"] == args.view)
    info = json.loads(subprocess.run(["splat", "info", args.scene, "--json", "-"], check=True, capture_output=True,
                                     text=True).stdout)
    inner = info["inner_bounds"]
    centre = [(low + high) / 2 for low, high in zip(inner["min"], inner["max"])]
    tried = models(view, centre)
    with tempfile.TemporaryDirectory() as folder:
        reports = study.reports([point(args, number, {**view, **lens}, options, folder) for number, (_, lens, options) in enumerate(tried)])
    found = [figures(report) for report in reports]
    print(f"{args.view} of {os.path.basename(args.scene)}, {info['gaussians']:,} Gaussians, "
          f"{view['width']}x{view['height']}, on {clocked.name(found[0]['clock'])}\n")
    print("| camera | seen | pairs | cycles of `project` | more | of the frame | more |\n"
          "|---|--:|--:|--:|--:|--:|--:|")
    for (name, _, _), one in zip(tried, found, strict=True):
        print(row(name, one, found[0]))


if __name__ == "__main__":
    command_line.run(main)
