#!/usr/bin/env python3
"""Gaussian invocations against tile size: every scene, resolution and support, as a table.

usage: bench/invocations.py [--scenes NAME...] [--widths PX...] [--out FOLDER]
Needs `splat` on the path (scripts/env.sh) and scenes in ../shared/data. Each analysis is a JSON file in FOLDER (default
build/invocations); those that are there, made from the same, are not made again, so an interrupted run goes on where it
stopped.
"""

import argparse
import json
import os
import subprocess
import sys
import time

import command_line
import kept
import scenes

SUPPORTS = ("box3", "square3")
WIDTHS = (480, 960, 1920, 3840)


def file_of(folder, scene, view, width):
    return os.path.abspath(os.path.join(folder, f"{scene.name}-{view}-{width}.json"))


def origin_of(scene, view, width):
    """What an analysis is made from."""
    return kept.origin({"scene": scene.path, "cameras": scene.cameras}, ["--view", view, "--width", str(width)])


def analysis(folder, scene, view, width):
    """The JSON of one `splat analyze`; one that is there, made from the same, is not made again."""
    out = file_of(folder, scene, view, width)
    os.makedirs(folder, exist_ok=True)

    def make():
        start = time.monotonic()
        subprocess.run(["splat", "analyze", scene.path, "--cameras", scene.cameras, "--view", view,
                        "--width", str(width), "--json", out], cwd=scenes.ROOT, check=True, stdout=subprocess.DEVNULL)
        print(f"{scene.name} {view} {width}: {time.monotonic() - start:.1f} s", file=sys.stderr, flush=True)

    kept.once([out], origin_of(scene, view, width), make)
    with open(out, encoding="utf-8") as f:
        return json.load(f)


def main():
    known = scenes.known()
    if not known:
        sys.exit("invocations.py: error: no ../shared/data, expected scenes and cameras there")
    parser = argparse.ArgumentParser(description="Gaussian invocations against tile size")
    parser.add_argument("--scenes", nargs="+", choices=known, default=known)
    parser.add_argument("--widths", nargs="+", type=int, default=WIDTHS)
    parser.add_argument("--out", default=os.path.join(scenes.ROOT, "build", "invocations"))
    options = parser.parse_args()

    columns = [(support, width) for support in SUPPORTS for width in options.widths]
    print("Fewer Gaussian invocations with tiles of 64 than of 16 pixels, percent\n")
    print("| scene | view | " + " | ".join(f"{s} {w}" for s, w in columns) + " |")
    print("|---|---|" + "--:|" * len(columns))
    for scene in map(scenes.shared, options.scenes):
        for view in scene.views:
            found = {width: analysis(options.out, scene, view, width)["invocations_by_support"]
                     for width in options.widths}
            cells = []
            for support, width in columns:
                pairs = found[width][support]
                cells.append(f"{100 * (1 - pairs['64'] / pairs['16']):.1f}" if pairs["16"] else "none")
            print(f"| {scene.name} | {view} | " + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    command_line.run(main)
