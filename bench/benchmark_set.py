#!/usr/bin/env python3
"""Whether the benchmark set is what it was: its bytes, its pictures, and the cycles of its frames on `prototype`.

usage: bench/benchmark_set.py [--scenes NAME...] [--sizes WIDTHxHEIGHT...] [--write] [--out FOLDER]
Compares with bench/benchmark_set.json, or writes what it finds there with --write. Pictures are of the raster path; only those
with a side below 1000 pixels are timed. FOLDER (default build/benchmark-set/runs) keeps each run (docs/studies.md). Exit codes:
0 the same, 1 something differs.
"""

import argparse
import json
import os
import sys

import command_line
import scenes
import study

FILE = os.path.join(scenes.ROOT, "bench", "benchmark_set.json")
SIZES = ("320x178", "980x545", "1920x1088")
MACHINE = "prototype"


def is_timed(size):
    return int(size.split("x")[0]) < 1000


def point(scene, view, size):
    return study.render(f"{scene.name}-{view}-{size}", scene, view, "--size", size, "--path", "raster", *(["--time"] if is_timed(size) else []),
                        VORION_CONFIG=MACHINE)


def found(name, sizes, folder):
    """Hashes and cycles of a scene, by view and size."""
    scene = scenes.generated(name)
    views = {}
    for view in scene.views:
        views[view] = {}
        for size, result in zip(sizes, study.measure([point(scene, view, size) for size in sizes], folder)):
            report = result["report"]
            views[view][size] = {"picture_fnv1a64": report["result_fnv1a64"]}
            if is_timed(size):
                views[view][size]["cycles"] = report["time"]["sum"]["cycles"]
            file = report["scene"]["fnv1a64"]
    return {"scene_fnv1a64": file, "views": views}


def differences(name, want, got, sizes):
    """A line for each thing of a scene that differs."""
    if want is None:
        return [f"{name}: not in {os.path.basename(FILE)}"]
    lines = [f"{name}: scene {got['scene_fnv1a64']}, expected {want['scene_fnv1a64']}"] * (got["scene_fnv1a64"] != want["scene_fnv1a64"])
    for view, by_size in got["views"].items():
        for size in sizes:
            for what, value in by_size[size].items():
                expected = want["views"].get(view, {}).get(size, {}).get(what)
                if value != expected:
                    lines.append(f"{name} {view} {size}: {what} {value}, expected {expected}")
    return lines


def merge(kept, got):
    """Puts what was found among what is kept."""
    if kept.get("scene_fnv1a64") != got["scene_fnv1a64"]:
        return got
    for view, by_size in got["views"].items():
        kept["views"].setdefault(view, {}).update(by_size)
    return kept


def main():
    parser = argparse.ArgumentParser(description="The benchmark set's hashes and cycles")
    parser.add_argument("--scenes", nargs="+", choices=scenes.PUBLIC, default=scenes.PUBLIC, metavar="NAME")
    parser.add_argument("--sizes", nargs="+", choices=SIZES, default=SIZES, metavar="WIDTHxHEIGHT")
    parser.add_argument("--write", action="store_true", help="write what is found instead of comparing it")
    parser.add_argument("--out", default=os.path.join(scenes.ROOT, scenes.GENERATED, "runs"), metavar="FOLDER")
    args = parser.parse_args()
    kept = {}
    if os.path.exists(FILE):
        with open(FILE, encoding="utf-8") as file:
            kept = json.load(file)
    lines = []
    for name in args.scenes:
        got = found(name, args.sizes, args.out)
        if args.write:
            kept[name] = merge(kept.get(name, {}), got)
        else:
            lines += differences(name, kept.get(name), got, args.sizes)
    if args.write:
        with open(FILE, "w", encoding="utf-8") as file:
            json.dump({name: kept[name] for name in scenes.PUBLIC if name in kept}, file, indent=1)
            file.write("\n")
    for line in lines:
        print(f"benchmark_set.py: {line}", file=sys.stderr)
    if lines:
        print("benchmark_set.py: error: the set differs, expected what bench/benchmark_set.json has; --write replaces it", file=sys.stderr)
        return 1
    print(f"{len(args.scenes)} scenes, {'written' if args.write else 'the same'}")
    return 0


if __name__ == "__main__":
    command_line.run(main)
