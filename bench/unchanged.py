#!/usr/bin/env python3
"""Whether two builds draw, count, time and train alike: for changes that must not change anything.

usage: bench/unchanged.py --out FOLDER [--scenes NAME,...] [--views NAME,...] [--no-clock] [--jobs N]
                         [--before-set KEY=VALUE,...] [--after-set KEY=VALUE,...] BEFORE AFTER

BEFORE and AFTER are build folders, or what `cmake --install` made of them. With --before-set and --after-set each has
a machine of its own (VORION_SET): one build and two engines show that these do the same. Renders every view of every scene of ../shared/data on both
paths with the clock on, trains three iterations of a capture on both paths, and compares pictures byte by
byte and reports value by value: counters, cycles, effects, everything but times of the host, versions and hashes of
programs. Small scenes come first. FOLDER keeps what each build gave; a run of the same programs is not
made again, so it goes on where it broke off. Prints a line for each run that differs, and the number of runs. Exit codes: 0 all the same, 1
something differs or a run failed.
"""

import argparse
import concurrent.futures
import functools
import hashlib
import json
import os
import subprocess
import sys
import tempfile

import command_line
import scenes

PATHS = ("raster", "simt")
# What differs between two runs of one program, or between two builds of one program; "set" is what was asked for.
HOST_KEYS = {"seconds", "programs", "program", "version", "origin", "set"}
CAPTURE = os.path.join("..", "shared", "data", "captures", "chair_synthetic")


class Build:
    """A folder with bin/ and pocl/lib/libvorion-pocl.so."""

    def __init__(self, folder, out, name, setting):
        self.folder = os.path.abspath(folder)
        if not os.path.exists(os.path.join(self.folder, "bin", "splat")):
            sys.exit(f"unchanged.py: error: {folder}: has no bin/splat, expected a build folder or an installed Vorion")
        self.name = name
        self.setting = setting
        self.environment = os.environ | {
            "VORION_ROOT": self.folder, "OCL_ICD_VENDORS": os.path.join(self.folder, "pocl", "lib", "libvorion-pocl.so"),
            "PATH": os.path.join(self.folder, "bin") + os.pathsep + os.environ["PATH"],
            "POCL_CACHE_DIR": os.path.join(out, f"cache-{name}")}
        if setting:
            self.environment["VORION_SET"] = setting

    @functools.cached_property
    def programs(self):
        said = self.run(["splat", "--version"])
        return said.split()[-1]

    def run(self, command):
        run = subprocess.run(command, env=self.environment, cwd=scenes.ROOT, capture_output=True, text=True)
        if run.returncode != 0:
            sys.exit(f"unchanged.py: error: {' '.join(command)} failed with {self.name}: {run.stderr[-500:]}")
        return run.stdout


def comparable(value, folder):
    """A report without what is the host's, and without the name of the folder that it lay in."""
    if isinstance(value, dict):
        return {key: comparable(v, folder) for key, v in value.items()
                if key not in HOST_KEYS and not key.endswith("_seconds")}
    if isinstance(value, list):
        return [comparable(v, folder) for v in value]
    return value.replace(folder, "") if isinstance(value, str) else value


def differences(before, after, where=""):
    """The places where two documents differ, as paths of keys."""
    if isinstance(before, dict) and isinstance(after, dict):
        return [d for key in sorted(before.keys() | after.keys())
                for d in differences(before.get(key), after.get(key), f"{where}.{key}" if where else key)]
    if isinstance(before, list) and isinstance(after, list) and len(before) == len(after):
        return [d for n, pair in enumerate(zip(before, after)) for d in differences(*pair, f"{where}[{n}]")]
    return [] if before == after else [f"{where}: {shortened(before)} before, {shortened(after)} after"]


def shortened(value, most=60):
    """A value as text, for a line that people read: lists of reports are long."""
    text = str(value)
    return text if len(text) <= most else text[:most] + "..."


def outcome(build, out, key, command, result):
    """What a command leaves: the hash of its result and its report; kept under the key while the programs are the same."""
    kept = os.path.join(out, f"{build.name}-{key}.json")
    made_from = {"programs": build.programs, "command": command, "set": build.setting}
    try:
        with open(kept, encoding="utf-8") as f:
            document = json.load(f)
        if document["made_from"] == made_from:
            return document["outcome"]
    except (FileNotFoundError, ValueError, KeyError):
        pass
    with tempfile.TemporaryDirectory(dir=out) as folder:
        paths = [os.path.join(folder, name) for name in (result, "report.json")]
        build.run([*command, "-o", paths[0], "--json", paths[1]])
        with open(paths[0], "rb") as f:
            content = hashlib.sha256(f.read()).hexdigest()
        with open(paths[1], encoding="utf-8") as f:
            report = comparable(json.load(f), folder)
    document = {"made_from": made_from, "outcome": {"result": content, "report": report}}
    with open(kept + ".new", "w", encoding="utf-8") as f:
        json.dump(document, f)
    os.replace(kept + ".new", kept)
    return document["outcome"]


def cases(args):
    """Name, command and kind of result of every run; small scenes first."""
    clock = [] if args.no_clock else ["--time"]
    known = [scenes.shared(name) for name in scenes.known() if not args.scenes or name in args.scenes.split(",")]
    for scene in sorted(known, key=scenes.size):
        for view in scene.views:
            if args.views and view not in args.views.split(","):
                continue
            for path in PATHS:
                yield (f"{scene.name}-{view}-{path}",
                       ["splat", "render", scene.path, "--cameras", scene.cameras, "--view", view, "--path", path, *clock],
                       "picture.npz")
    if not args.scenes and os.path.isdir(os.path.join(scenes.ROOT, CAPTURE)):
        for path in PATHS:
            yield (f"train-{path}", ["splat", "train", CAPTURE, "--downscale", "8", "--background", "1,1,1", "--iterations",
                                     "3", "--max-gaussians", "2000", "--path", path], "scene.ply")


def compare(args, builds, case):
    key, command, result = case
    before, after = (outcome(build, args.out, key, command, result) for build in builds)
    found = [] if before["result"] == after["result"] else [f"{result} differs"]
    return key, found + differences(before["report"], after["report"])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("before")
    parser.add_argument("after")
    parser.add_argument("--out", required=True)
    parser.add_argument("--scenes")
    parser.add_argument("--views")
    parser.add_argument("--no-clock", action="store_true")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--before-set", metavar="KEY=VALUE,...")
    parser.add_argument("--after-set", metavar="KEY=VALUE,...")
    args = parser.parse_args()
    os.makedirs(args.out, exist_ok=True)
    args.out = os.path.abspath(args.out)
    builds = [Build(args.before, args.out, "before", args.before_set), Build(args.after, args.out, "after", args.after_set)]
    runs, differ = 0, 0
    with concurrent.futures.ThreadPoolExecutor(args.jobs) as pool:
        for key, found in pool.map(lambda case: compare(args, builds, case), list(cases(args))):
            runs += 1
            differ += bool(found)
            print(f"{key}: {'the same' if not found else '; '.join(found[:5])}", flush=True)
    print(f"{runs} runs, {runs - differ} the same, {differ} differ")
    sys.exit(1 if differ or not runs else 0)


if __name__ == "__main__":
    command_line.run(main)
