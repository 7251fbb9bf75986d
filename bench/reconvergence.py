#!/usr/bin/env python3
"""Warp and lane instructions of frames without early reconvergence and with it (docs/backend.md).

usage: reconvergence.py --out FOLDER [--scenes NAME,...]

Draws every view of ../shared/data on both paths with `-mllvm -vorion-reconverge=false` and without it, and prints a table of
Markdown, a view a line: millions of instructions without it, and what it changes. FOLDER keeps each run's result
(docs/studies.md). Exit codes: 0, 1 a picture differs.
"""

import argparse
import os
import sys

import command_line
import scenes
import study

OPTIONS = {"without": "-mllvm -vorion-reconverge=false", "with": ""}
COUNTERS = ("warp_instructions", "lane_instructions")


def drawn(out, scene, view, path):
    """The counters of both, and whether the pictures are the same."""
    reports = []
    for what, options in OPTIONS.items():
        # Kernels are kept by their text, which does not have the compiler's options.
        cache = os.path.join(os.path.abspath(out), f"cache-{what}")
        variables = {"VORION_REMARKS": options} if options else {}
        point = study.render(f"{what}-{scene.name}-{view}-{path}", scene, view, "--path", path, VORION_CONFIG="prototype", **variables)
        result, = study.measure([point], out, POCL_CACHE_DIR=cache)
        reports.append(result["report"])
    before, after = ([said["total"]["counters"][name] for name in COUNTERS] for said in reports)
    return before, after, reports[0]["result_fnv1a64"] == reports[1]["result_fnv1a64"]


def change(now, before):
    """In per cent."""
    percent = f"{100 * (now / before - 1):+.2f}"
    return "0.00" if percent in ("+0.00", "-0.00") else percent


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", required=True)
    parser.add_argument("--scenes", default=",".join(scenes.known()))
    options = parser.parse_args()
    chosen = sorted(map(scenes.shared, options.scenes.split(",")), key=scenes.size)
    different = 0
    print("| view | path | warp instructions, million | change, % | lane instructions, million | change, % |")
    print("|---|---|--:|--:|--:|--:|")
    for scene in chosen:
        for view in scene.views:
            for path in ("raster", "simt"):
                before, after, same = drawn(options.out, scene, view, path)
                cells = [cell for was, now in zip(before, after) for cell in (f"{was / 1e6:,.2f}", change(now, was))]
                print(f"| {scene.name} {view} | `{path}` | {' | '.join(cells)} |", flush=True)
                if not same:
                    print(f"reconvergence.py: error: {scene.name} {view} on {path}: the picture has other bits, expected the same",
                          file=sys.stderr)
                    different += 1
    return 1 if different else 0


if __name__ == "__main__":
    command_line.run(main)
