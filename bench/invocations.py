#!/usr/bin/env python3
"""Gaussian invocations against tile size: every scene, resolution and support, as a table.

usage: bench/invocations.py [--scenes NAME...] [--widths PX...] [--out FOLDER]
Needs `splat` on the path (scripts/env.sh) and scenes in ../shared/data. Each analysis is a JSON file in FOLDER (default
build/invocations); those that are there are not made again, so an interrupted run goes on where it stopped.
"""

import argparse
import glob
import json
import os
import subprocess
import sys
import time

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
SCENES = os.path.join(ROOT, "..", "shared", "data", "scenes")
SUPPORTS = ("box3", "square3")


def analysis(folder, scene, view, width):
    out = os.path.join(folder, f"{scene}-{view}-{width}.json")
    if not os.path.exists(out):
        path = sorted(glob.glob(os.path.join(SCENES, scene + ".*")))[0]
        start = time.monotonic()
        subprocess.run(["splat", "analyze", path, "--cameras", os.path.join(SCENES, "cameras", scene + ".json"),
                        "--view", view, "--width", str(width), "--json", out], check=True, stdout=subprocess.DEVNULL)
        print(f"{scene} {view} {width}: {time.monotonic() - start:.1f} s", file=sys.stderr)
    with open(out) as f:
        return json.load(f)["invocations_by_support"]


def main():
    if not os.path.isdir(SCENES):
        sys.exit("invocations.py: error: no ../shared/data, expected scenes and cameras there")
    known = sorted(os.path.splitext(os.path.basename(f))[0] for f in glob.glob(os.path.join(SCENES, "cameras", "*.json")))
    parser = argparse.ArgumentParser(description="Gaussian invocations against tile size")
    parser.add_argument("--scenes", nargs="+", choices=known, default=known)
    parser.add_argument("--widths", nargs="+", type=int, default=[480, 960, 1920, 3840])
    parser.add_argument("--out", default=os.path.join(ROOT, "build", "invocations"))
    options = parser.parse_args()
    os.makedirs(options.out, exist_ok=True)

    columns = [(support, width) for support in SUPPORTS for width in options.widths]
    print("Fewer Gaussian invocations with tiles of 64 than of 16 pixels, percent\n")
    print("| scene | view | " + " | ".join(f"{s} {w}" for s, w in columns) + " |")
    print("|---|---|" + "--:|" * len(columns))
    for scene in options.scenes:
        with open(os.path.join(SCENES, "cameras", scene + ".json")) as f:
            views = [camera["img_name"] for camera in json.load(f)]
        for view in views:
            found = {width: analysis(options.out, scene, view, width) for width in options.widths}
            cells = []
            for support, width in columns:
                pairs = found[width][support]
                cells.append(f"{100 * (1 - pairs['64'] / pairs['16']):.1f}" if pairs["16"] else "none")
            print(f"| {scene} | {view} | " + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    main()
