"""Runs of splat on a machine, each kept in a file of its own: what is there is not run again."""

import array
import collections
import concurrent.futures
import glob
import hashlib
import json
import os
import re
import subprocess
import sys
import tempfile
import threading
import time
import zipfile
from dataclasses import dataclass

import kept
import machines
import scenes


class Failed(Exception):
    """A run ended with an error, in one line."""


class Missing(Exception):
    """A run has not been made, and none is to be made now."""


@dataclass(frozen=True)
class Run:
    """A render of a view on a machine; machine is a name of machines.py."""
    scene: scenes.Scene
    view: str
    machine: str
    options: tuple = ()
    clock: int = 0           # MHz; 0: the machine's own, None: no clock
    threads: int = 0         # of the host; 0: as the machine has it
    picture: bool = False    # keep it
    output = "out.pfm"       # what splat writes
    any_build = False        # whether one that another build made is as good

    def name(self):
        parts = [self.scene.name, self.view, self.machine, *self.options]
        parts += ["untimed"] if self.clock is None else [f"{self.clock}MHz"] if self.clock else []
        parts += [f"{self.threads}threads"] if self.threads else []
        return file_name(parts)

    def inputs(self):
        """The files and folders that it reads, by what they are."""
        return {"scene": self.scene.path, "cameras": self.scene.cameras}

    def beside(self):
        """The endings of files that are kept beside the result."""
        return [".pfm"] if self.picture else []

    def arguments(self, output, report):
        timed = () if self.clock is None else ("--clock", str(self.clock)) if self.clock else ("--time",)
        return ["splat", "render", self.scene.path, "--cameras", self.scene.cameras, "--view", self.view,
                "-o", output, "--json", report, *timed, *self.options]

    def config(self):
        """The machine, as VORION_CONFIG takes it."""
        config = machines.config(self.machine)
        if self.threads:
            config["host_threads"] = self.threads
        return config

    def command(self):
        """What to type in the root of the repository."""
        return (f"VORION_CONFIG={machines.shown(self.machine)} "
                + " ".join(self.arguments(self.output, "out.json")))

    @staticmethod
    def trimmed(report):
        """What the sections read: whole frames and cycles of stages."""
        if timed := report.get("time"):
            trim(timed)
        return report


def _content(output):
    """A hash of what was written: the file, or one of each view with the view's name in front of its ending."""
    digest = hashlib.sha256()
    base, ending = os.path.splitext(output)
    for file in [output] if os.path.exists(output) else sorted(glob.glob(glob.escape(base) + ".*" + ending)):
        with open(file, "rb") as f:
            digest.update(f.read())
    return digest.hexdigest()


def clock_versions(result):
    """Versions of the clock that a result's times are of; none without a clock."""
    timed = [*result.get("timed", ()), *([result] if "time" in result else [])]
    return {sample["time"]["sum"]["clock_version"] for sample in timed}


def file_name(parts):
    return re.sub(r"[^A-Za-z0-9_.-]+", "_", "-".join(part.lstrip("-") for part in parts))


def trim(timed, whole=()):
    """Drops what no section reads; of the stages that `whole` names, the rasterizers stay."""
    timed["sum"].pop("activities", None)
    for stage in timed["stages"]:
        if "time" in stage:
            keys = ("cycles", "dram", "rasterizers") if stage["name"] in whole else ("cycles", "dram")
            stage["time"] = {key: stage["time"][key] for key in keys}


class Runs:
    """The folder of the results. keep: take those of other builds, too. only_kept: make no new ones."""

    def __init__(self, folder, jobs, keep, only_kept):
        self.folder, self.jobs, self.keep, self.only_kept = folder, jobs, keep, only_kept
        self.build = kept.programs()
        self.begin_section()
        self.lock = threading.Lock()
        os.makedirs(os.path.join(folder, "runs"), exist_ok=True)

    def file(self, run, suffix):
        return os.path.join(self.folder, "runs", run.name() + suffix)

    def kept(self, run):
        """The result of an earlier run, or None."""
        try:
            with open(self.file(run, ".json"), encoding="utf-8") as f:
                result = json.load(f)
        except FileNotFoundError:
            return None
        other_build = result["build"] != self.build and not self.keep and not run.any_build
        if other_build or not all(os.path.exists(self.file(run, ending)) for ending in run.beside()):
            return None
        if kept.differences(result.get("made_from"), self.origin(run)):
            kept.say_stale(self.file(run, ".json"), result.get("made_from"), self.origin(run))
            for ending in run.beside():  # a training run would go on from its checkpoint
                os.remove(self.file(run, ending))
            return None
        return result

    @staticmethod
    def origin(run):
        """What a run is made from beside the programs, as its result says."""
        return {**{what: kept.content(path) for what, path in run.inputs().items()}, "machine": run.config(),
                "command": run.arguments("OUTPUT", "REPORT")}

    def execute(self, run):
        config = run.config()
        with tempfile.TemporaryDirectory(dir=self.folder) as folder:
            output, report = os.path.join(folder, run.output), os.path.join(folder, "out.json")
            start = time.monotonic()
            done = subprocess.run(run.arguments(output, report), cwd=scenes.ROOT, capture_output=True, text=True,
                                  env=dict(os.environ, VORION_CONFIG=json.dumps(config)), check=False)
            if done.returncode != 0:
                lines = done.stderr.strip().splitlines() or [f"splat ended with {done.returncode}"]
                raise Failed(f"{run.name()}: {lines[-1]}")
            with open(report, encoding="utf-8") as f:
                result = run.trimmed(json.load(f))
            result.pop("picture", None)
            result["picture_sha256"] = _content(output)
            result["channels"] = machines.channels(run.machine)
            result.update(build=self.build, made_from=self.origin(run), seconds=time.monotonic() - start, command=run.command())
            if ".pfm" in run.beside():
                os.replace(output, self.file(run, ".pfm"))
            with open(report, "w", encoding="utf-8") as f:
                json.dump(result, f)
            os.replace(report, self.file(run, ".json"))
        return result

    def all(self, wanted, title):
        """The results of some runs, in order; those that are missing are run, with a line each, or else raise Missing."""
        wanted = list(wanted)
        results = {run: self.kept(run) for run in wanted}
        missing = [run for run, result in results.items() if result is None]
        if missing and self.only_kept:
            raise Missing(missing[0].name())
        count = 0

        def one(run):
            nonlocal count
            result = self.execute(run)
            with self.lock:
                count += 1
                print(f"{title} [{count}/{len(missing)}] {run.name()}: {result['seconds']:.1f} s", file=sys.stderr,
                      flush=True)
            return result

        with concurrent.futures.ThreadPoolExecutor(self.jobs) as pool:
            futures = {run: pool.submit(one, run) for run in missing}
            try:
                for run, future in futures.items():
                    results[run] = future.result()
            except BaseException:
                pool.shutdown(cancel_futures=True)
                raise
        for run, result in results.items():
            self.builds.add(result["build"])
            self.clocks |= clock_versions(result)
            self.seconds[run.name()] = result["seconds"]
        return [results[run] for run in wanted]

    def begin_section(self):
        """Forgets what the section before asked for."""
        self.builds, self.clocks, self.left_out, self.seconds = set(), set(), [], {}

    def prepare(self, wanted, title):
        """Makes all runs that a section will ask for, several at a time."""
        if not self.only_kept:
            self.all(wanted, title)

    def those_there(self, wanted, title):
        """The results of some runs, by what `wanted` has them under; without those that all() would raise Missing for, which
        are named as left out."""
        results = {}
        for key, run in wanted.items():
            try:
                results[key], = self.all([run], title)
            except Missing as missing:
                self.left_out.append(str(missing))
        return results

    def rows(self, places, make):
        """make(*place) for every place whose runs are there: all of them, unless only kept ones are taken."""
        rows = []
        for place in places:
            try:
                rows.append(make(*place))
            except Missing as missing:
                print(f"left out: {missing}", file=sys.stderr)
                self.left_out.append(" ".join(str(getattr(part, "name", part)) for part in place if part is not self))
        return rows

    def write(self, section, data):
        """Keeps what a section found."""
        file = os.path.join(self.folder, section + ".json")
        with open(file + ".new", "w", encoding="utf-8") as f:
            json.dump(data, f, indent=1)
            f.write("\n")
        os.replace(file + ".new", file)

    def read(self, section):
        """The same, or None."""
        try:
            with open(os.path.join(self.folder, section + ".json"), encoding="utf-8") as f:
                return json.load(f)
        except FileNotFoundError:
            return None

    def lengths(self, scene, view):
        """Entries of every tile's list, from the pairs that a render sorts."""
        out = os.path.join(self.folder, "runs", f"{scene.name}-{view}-lengths.json")
        made_from = kept.origin({"scene": scene.path, "cameras": scene.cameras}, ["--view", view])
        if self.only_kept and not kept.is_kept([out], made_from):
            raise Missing(f"{scene.name}-{view}-lengths")

        def make():
            with tempfile.TemporaryDirectory(dir=self.folder) as folder:
                pairs = os.path.join(folder, "pairs.npz")
                subprocess.run(["splat", "render", scene.path, "--cameras", scene.cameras, "--view", view, "-o",
                                os.path.join(folder, "out.pfm"), "--dump-pairs", pairs], cwd=scenes.ROOT, check=True,
                               stdout=subprocess.DEVNULL)
                lengths = collections.Counter(_column(pairs, "tile"))
            return [lengths[tile] for tile in range(tiles(scene, view))]

        return kept.result(out, made_from, make)


def tiles(scene, view, side=64):
    """How many tiles of that side a view has."""
    with open(os.path.join(scenes.ROOT, scene.cameras), encoding="utf-8") as f:
        camera = next(c for c in json.load(f) if c["img_name"] == view)
    return -(-camera["width"] // side) * -(-camera["height"] // side)


def _column(file, name):
    """A one-dimensional array of 32-bit integers in an .npz file."""
    with zipfile.ZipFile(file) as archive:
        content = archive.read(name + ".npy")
    header = 10 + int.from_bytes(content[8:10], "little")
    if b"'<u4'" not in content[:header] and b"'<i4'" not in content[:header]:
        raise Failed(f"{file}: {name} has no 32-bit integers, expected those of --dump-pairs")
    return array.array("I", content[header:])


def stage_cycles(result, stage):
    return sum(s["time"]["cycles"] for s in result["time"]["stages"] if s["name"] == stage and "time" in s)


def parted(parts):
    """Options of the raster path for K parts; none for one, so that it is the plain frame's run."""
    return ("--path", "raster", *(("--ztiles", str(parts)) if parts > 1 else ()))


def kernel_cycles(result, kernel):
    """Of all launches of a kernel of the frame."""
    return sum(k["cycles"] for s in result["time"]["stages"] for k in s.get("kernels", ()) if k["name"] == kernel)


def stage_instructions(result, stage):
    return sum(k["counters"]["warp_instructions"] for s in result["stages"] if s["name"] == stage
               for k in s["kernels"])


def frame_cycles(result):
    return result["time"]["sum"]["cycles"]


def frame_ms(result):
    """The frame with its launches and small copies."""
    return result["time"]["frame_ms"]


def overlapped_ms(result):
    """What a frame of the raster path would take if others ran beside it: the longer of the cores' stages and of the
    rasterizers' one, with launches and copies. Nothing is charged for sharing memory, so it is a bound."""
    blend, whole = stage_cycles(result, "blend"), frame_cycles(result)
    kernels = result["time"]["kernel_ms"]
    return frame_ms(result) - kernels + kernels * max(blend, whole - blend) / whole
