#!/usr/bin/env python3
"""Every scene and view with what it calls for compiled in, with everything, and with run-time flags.

usage: bench/effects.py --out FOLDER [--scenes NAME,...] [--views NAME,...] [--clock] [--first-frame] [--json FILE]
                        [-- OPTIONS of splat render]

Renders each view of each scene of ../shared/data with --effects auto, all and flags, and prints the
effects that are on, warp instructions of the frame (with --clock also cycles), processor seconds of the
process, and whether the three pictures have the same bits. Small scenes come first. FOLDER keeps each
run's result (docs/studies.md) and PoCL's cache.
--first-frame instead renders each view four times: auto and flags with an empty cache, which counts
compiling, and both again. Exit codes: 0, 1 a run failed or pictures differ.
"""

import argparse
import json
import os
import shutil
import sys

import clocked
import command_line
import scenes
import study

MODES = ("auto", "all", "flags")


def chosen(names):
    """The scenes beside the repository that are among names, or all; small files first."""
    found = [scenes.shared(name) for name in scenes.known() if not names or name in names]
    return sorted(found, key=scenes.size)


def point(args, name, scene, view, mode):
    clock = ["--time"] if args.clock else []
    return study.render(name, scene, view, "--effects", mode, *clock, *args.options)


def found_by(result, view, mode):
    """What the tables and --json have of a run."""
    full = result["report"]
    found = {"scene": full["scene"], "view": view, "mode": mode, "device": full["device"],
             "options": full["options"], "effects": full["effects"], "programs": full["programs"],
             "counts": full["counts"], "picture": full["result_fnv1a64"], "processor_seconds": result["processor_seconds"],
             "warp_instructions": full["total"]["counters"]["warp_instructions"],
             "by_stage": {s["name"]: sum(k["counters"]["warp_instructions"] for k in s["kernels"])
                          for s in full["stages"]},
             "seconds_by_stage": {s["name"]: s["seconds"] for s in full["stages"]}}
    if "time" in full:
        found["cycles"] = full["time"]["sum"]["cycles"]
        found["clocked_machine"] = clocked.name(full["time"]["sum"])
    return found


def on(result):
    """The effects of scene and machine that the view calls for."""
    return [e["name"] for e in result["effects"] if e["needed"] and e["kind"] != "observation"]


def change(value, base):
    return f"{100 * (value - base) / base:+.1f} %"


def compare(args):
    rows, differing = [], []
    print("| scene | view | on | instructions auto | all | flags |" + (" cycles auto | all | flags |" if args.clock else "")
          + " processor s auto | all | flags | same bits |")
    for scene in chosen(args.scenes):
        for view in scene.views:
            if args.views and view not in args.views:
                continue
            clock = "-clock" if args.clock else ""
            points = [point(args, f"{scene.name}-{view}-{m}{clock}", scene, view, m) for m in MODES]
            results = study.measure(points, args.out, POCL_CACHE_DIR=os.path.join(args.out, "cache"))
            runs = {m: found_by(result, view, m) for m, result in zip(MODES, results, strict=True)}
            auto = runs["auto"]
            same = len({r["picture"] for r in runs.values()}) == 1
            if not same:
                differing.append(f"{scene.name} {view}")
            cells = [scene.name, view, " ".join(on(auto)), f"{auto['warp_instructions']:,}"]
            cells += [change(runs[m]["warp_instructions"], auto["warp_instructions"]) for m in MODES[1:]]
            if args.clock:
                cells += [f"{auto['cycles']:,}"]
                cells += [change(runs[m]["cycles"], auto["cycles"]) for m in MODES[1:]]
            cells += [f"{runs[m]['processor_seconds']:.2f}" for m in MODES] + ["yes" if same else "NO"]
            print("| " + " | ".join(cells) + " |", flush=True)
            rows.append(runs)
    if args.clock and rows:
        clocked.say(run["clocked_machine"] for runs in rows for run in runs.values())
    return rows, differing


def first_frames(args):
    """Processor seconds of a process, with an empty cache and with a full one; the compiler's processes are not counted."""
    rows = []
    print("| scene | view | auto, empty cache | flags, empty cache | auto, cached | flags, cached |")
    for scene in chosen(args.scenes):
        view = args.views[0] if args.views else scene.views[0]
        caches = {m: os.path.join(args.out, f"first-{m}") for m in ("auto", "flags")}
        for cache in caches.values():
            shutil.rmtree(cache, ignore_errors=True)
        runs = {}
        for turn in ("first", "second"):
            for m, cache in caches.items():
                result, = study.measure([point(args, f"{scene.name}-{view}-{m}-{turn}", scene, view, m)], args.out, POCL_CACHE_DIR=cache)
                runs[m, turn] = found_by(result, view, m)
        cells = [f"{runs[m, turn]['processor_seconds']:.2f} s" for turn in ("first", "second")
                 for m in ("auto", "flags")]
        print("| " + " | ".join([scene.name, view] + cells) + " |", flush=True)
        rows.append({f"{m}-{turn}": r for (m, turn), r in runs.items()})
    return rows, []


def names(text):
    return text.split(",") if text else []


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", required=True, help="folder for the runs")
    parser.add_argument("--scenes", type=names, default=[])
    parser.add_argument("--views", type=names, default=[])
    parser.add_argument("--clock", action="store_true", help="cycles too")
    parser.add_argument("--first-frame", action="store_true", help="with and without compiling")
    parser.add_argument("--json", help="write all results")
    parser.add_argument("options", nargs="*", help="for splat render, after --")
    args = parser.parse_args()
    if not scenes.known():
        sys.exit("effects.py: error: ../shared/data is missing, expected the scenes there")
    args.out = os.path.abspath(args.out)
    os.makedirs(args.out, exist_ok=True)
    rows, differing = first_frames(args) if args.first_frame else compare(args)
    if args.json:
        with open(args.json, "w", encoding="utf-8") as f:
            json.dump(rows, f, indent=1)
    if differing:
        sys.exit(f"effects.py: error: pictures differ: {', '.join(differing)}")


if __name__ == "__main__":
    command_line.run(main)
