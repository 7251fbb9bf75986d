#!/usr/bin/env python3
"""Gaussian invocations against tile size: every scene, resolution and support, as a table.

usage: bench/invocations.py [--scenes NAME...] [--widths PX...] [--out FOLDER]
Needs `splat` on the path (scripts/env.sh) and scenes in ../shared/data. FOLDER (default build/invocations) keeps each analysis
(docs/studies.md).
"""

import argparse
import os
import sys

import command_line
import scenes
import study

SUPPORTS = ("box3", "square3")
WIDTHS = (480, 960, 1920, 3840)


def point(scene, view, width):
    """An analysis of a view."""
    command = ("splat", "analyze", "{scene}", "--cameras", "{cameras}", "--view", view, "--size", str(width), "--json", "{out}.json")
    return study.Point(f"{scene.name}-{view}-{width}", command, {"scene": scene.path, "cameras": scene.cameras})


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
            results = study.measure([point(scene, view, width) for width in options.widths], options.out)
            found = {width: result["report"]["invocations_by_support"] for width, result in zip(options.widths, results)}
            cells = []
            for support, width in columns:
                pairs = found[width][support]
                cells.append(f"{100 * (1 - pairs['64'] / pairs['16']):.1f}" if pairs["16"] else "none")
            print(f"| {scene.name} | {view} | " + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    command_line.run(main)
