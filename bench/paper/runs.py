"""Runs of splat on a machine, each kept in a file of its own: what is there is not run again."""

import dataclasses
import json
import os
import re
import sys
from dataclasses import dataclass

import machines
import scenes
import study


class Failed(Exception):
    """A result is not what it has to be, in one line."""


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

    def name(self):
        parts = [self.scene.name, self.view, self.machine, *self.options]
        parts += ["untimed"] if self.clock is None else [f"{self.clock}MHz"] if self.clock else []
        parts += [f"{self.threads}threads"] if self.threads else []
        return file_name(parts)

    def words(self, scene, cameras, out):
        timed = () if self.clock is None else ("--clock", str(self.clock)) if self.clock else ("--time",)
        return ("splat", "render", scene, "--cameras", cameras, "--view", self.view, "-o", out + ".pfm", "--json", out + ".json",
                *timed, *self.options)

    def config(self):
        """The machine, as VORION_CONFIG takes it."""
        config = machines.config(self.machine)
        if self.threads:
            config["host_threads"] = self.threads
        return config

    def point(self):
        return study.Point(self.name(), self.words("{scene}", "{cameras}", "{out}"), {"scene": self.scene.path, "cameras": self.scene.cameras},
                           {"VORION_CONFIG": json.dumps(self.config())}, (".pfm",) if self.picture else ())

    def command(self):
        """What to type in the root of the repository."""
        return f"VORION_CONFIG={machines.shown(self.machine)} " + " ".join(self.words(self.scene.path, self.scene.cameras, "out"))

    @staticmethod
    def trimmed(report):
        """What the sections read: whole frames and cycles of stages."""
        if timed := report.get("time"):
            trim(timed)
        return report


def clock_versions(result):
    """Versions of the clock that a result's times are of; none without a clock."""
    timed = [*result.get("timed", ()), *([result] if "time" in result else [])]
    return {sample["time"]["sum"]["clock_version"] for sample in timed}


def file_name(parts):
    return re.sub(r"[^A-Za-z0-9_.-]+", "_", "-".join(part.lstrip("-") for part in parts))


def trim(timed):
    """Drops what no section reads."""
    timed["sum"].pop("activities", None)
    for stage in timed["stages"]:
        if "time" in stage:
            stage["time"] = {key: stage["time"][key] for key in ("cycles", "dram")}


class Runs:
    """The folder of the results. keep: take those of other builds, too. only_kept: make no new ones."""

    def __init__(self, folder, jobs, keep, only_kept):
        self.folder, self.jobs, self.keep, self.only_kept = folder, jobs, keep, only_kept
        self.found = {}  # results by point's name, without what no section reads
        self.missing = set()  # names of points that were looked for, and are to be left out
        self.begin_section()
        os.makedirs(folder, exist_ok=True)
        if os.path.isdir(earlier := os.path.join(folder, "runs")):
            print(f"{earlier}: results of an earlier paper.sh, not used: delete them", file=sys.stderr)

    def file(self, run, ending):
        return study.file_of(self.folder, run.point(), ending)

    def measured(self, points, trimmed=lambda report: report):
        """The results of some points, in order; those that are missing are measured, or else raise Missing."""
        points = [self._of_builds(point) for point in points]
        new = list({point.name: point for point in points if not self._is_found(point)}.values())
        for point in new:
            if point.name in self.missing:
                raise Missing(point.name)
        results = study.kept(new, self.folder) if self.only_kept else study.measure(new, self.folder, self.jobs)
        for point, result in zip(new, results, strict=True):
            if result is None:
                self.missing.add(point.name)
                raise Missing(point.name)
            self.found[point.name] = {**result, "report": trimmed(result["report"])}
        for point in points:
            result = self.found[point.name]
            self.builds.add(result["made_from"]["programs"])
            self.seconds[point.name] = result["seconds"]
        return [self.found[point.name] for point in points]

    def _is_found(self, point):
        """Whether a result is known, with all files that the point keeps: another section may have asked for it without a picture."""
        return point.name in self.found and all(os.path.exists(study.file_of(self.folder, point, ending)) for ending in point.keep)

    def _of_builds(self, point):
        return dataclasses.replace(point, any_build=point.any_build or self.keep)

    def all(self, wanted):
        """The reports of some runs, in order, with what the sections know besides; as measured(). All are of one kind."""
        wanted, reports = list(wanted), []
        results = self.measured([run.point() for run in wanted], wanted[0].trimmed) if wanted else []
        for run, result in zip(wanted, results, strict=True):
            self.clocks |= clock_versions(result["report"])
            reports.append({**result["report"], "output_fnv1a64": result["output_fnv1a64"], "command": run.command(),
                            "channels": machines.channels(run.machine)})
        return reports

    def begin_section(self):
        """Forgets what the section before asked for."""
        self.builds, self.clocks, self.left_out, self.seconds = set(), set(), [], {}

    def prepare(self, wanted):
        """Makes all runs that a section will ask for, several at a time; where only kept ones are taken, finds those at once."""
        wanted = list(wanted)
        if not self.only_kept:
            self.all(wanted)
            return
        points = {run.name(): self._of_builds(run.point()) for run in wanted if not self._is_found(run.point())}
        for run, result in zip(points, study.kept(list(points.values()), self.folder), strict=True):
            if result is None:
                self.missing.add(run)
            else:
                self.found[run] = {**result, "report": wanted[0].trimmed(result["report"])}

    def those_there(self, wanted):
        """The results of some runs, by what `wanted` has them under; without those that all() would raise Missing for, which
        are named as left out."""
        results = {}
        for key, run in wanted.items():
            try:
                results[key], = self.all([run])
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


def tiles(scene, view, side=64):
    """How many tiles of that side a view has."""
    with open(os.path.join(scenes.ROOT, scene.cameras), encoding="utf-8") as f:
        camera = next(c for c in json.load(f) if c["img_name"] == view)
    return -(-camera["width"] // side) * -(-camera["height"] // side)


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


def gaussians(result):
    """Of the scene, drawn or not."""
    return result["counts"]["visible"] + sum(result["counts"]["culled"].values())


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
