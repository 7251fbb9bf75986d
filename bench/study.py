"""Measurements by many runs: splat-study makes those that are missing, and keeps each in a file with what made it
(docs/studies.md). A script says which points it needs, and makes a table of their reports."""

import json
import os
import subprocess
import sys
import tempfile
from dataclasses import dataclass, field

import scenes


@dataclass(frozen=True)
class Point:
    """A run of a program of the build. In its words and variables `{out}` begins the names of the files that it writes, of
    which `{out}.json` is its report, and `{scene}` and so on are the paths of its inputs, as seen from scenes.ROOT."""
    name: str
    command: tuple
    inputs: dict = field(default_factory=dict)
    variables: dict = field(default_factory=dict)  # of the environment: VORION_CONFIG and so on
    keep: tuple = ()              # endings of files that stay beside the result; {kept} begins their names
    any_build: bool = False       # whether a result of another build serves
    may_be_refused: bool = False  # whether a usage error is a result, under "refused"

    def request(self):
        inputs = {what: os.path.join(scenes.ROOT, path) for what, path in self.inputs.items()}
        return {"name": self.name, "command": list(self.command), "inputs": inputs, "variables": self.variables,
                "keep": list(self.keep), "any_build": self.any_build, "may_be_refused": self.may_be_refused}


def render(name, of, view, *options, keep=(), may_be_refused=False, **variables):
    """A point that draws a view of a scene (scenes.py); variables: of the environment."""
    words = ("splat", "render", "{scene}", "--cameras", "{cameras}", "--view", view, "-o", "{out}.pfm", "--json", "{out}.json",
             *options)
    return Point(name, words, {"scene": of.path, "cameras": of.cameras}, variables, keep, may_be_refused=may_be_refused)


def file_of(folder, point, ending=".json"):
    """Where a result is, or a file beside it."""
    return os.path.join(folder, "points", point.name.replace("/", "_") + ending)


def _call(points, folder, jobs, measure, environment):
    if not points:
        return []
    request = {"folder": os.path.abspath(folder), "jobs": jobs, "measure": measure, "points": [point.request() for point in points]}
    done = subprocess.run(["splat-study"], input=json.dumps(request), stdout=subprocess.PIPE, text=True, cwd=scenes.ROOT,
                          env={**os.environ, **environment}, check=False)
    if done.returncode:
        sys.exit(1)  # it has said why
    results = []
    for file in json.loads(done.stdout):
        if file is None:
            results.append(None)
            continue
        with open(file, encoding="utf-8") as f:
            results.append(json.load(f))
    return results


def kept(points, folder):
    """The results that are there, made from the same; None for others."""
    return _call(points, folder, 1, False, {})


def measure(points, folder, jobs=1, **environment):
    """The results of points, in order: {"report", "refused", "output_fnv1a64", "seconds", "processor_seconds", "made_from"}. The processor seconds are the
    program's own and its children's, without those of the compiler, which is nobody's child.
    Those that are missing are measured, and a run that fails ends the script; environment: of all runs, and no part of what
    made a result."""
    return _call(points, folder, jobs, True, environment)


def reports(points):
    """The reports of points that are kept nowhere."""
    with tempfile.TemporaryDirectory() as folder:
        return [result["report"] for result in measure(points, folder)]
