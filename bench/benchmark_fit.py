#!/usr/bin/env python3
"""Fits the parameters of scenes of the benchmark set to the real scenes that they are measured beside (bench/benchmark_match.py).

usage: bench/benchmark_fit.py SCENE [--evaluations N] [--seeds N] [--only NAME...] [--start FILE] [--out FOLDER]
Needs `splat` and `splat-benchmark` on the path (scripts/env.sh), numpy, and ../shared/data. Prints the best parameters as they stand
in apps/splat/demo/BenchmarkShapes.cpp, and each ratio by seed, from a sample of the pixels: bench/benchmark_match.py counts them all.
FOLDER (default build/benchmark-fit) keeps the best parameters as JSON, from which --start goes on.

The method is one without derivatives: how the logarithms of the ratios follow the parameters is estimated by a small change of each,
and corrected by every evaluation (Broyden). A step minimizes a bounded loss of the predicted ratios within a trust region.
"""

import argparse
import concurrent.futures
import json
import math
import os
import queue
import subprocess

import numpy as np

import benchmark_match
import command_line
import scenes

# Of each parameter the least and the largest value, and whether its logarithm is fitted.
BOUNDS = {
    "Distance": (0.5, 2, True), "Second": (0.5, 2, True), "Third": (0.5, 2, True), "Behind": (0.02, 12, True), "Nowhere": (0.02, 2, True),
    "Back": (0.3, 4, True), "Fading": (0, 5, False), "Clumps": (0, 2, False), "Size": (0.25, 2.5, True), "SizeSpread": (0, 1.3, False),
    "BlockSize": (0, 0.8, False), "Stretch": (0, 2.2, False), "Large": (0, 0.3, False), "LargeSize": (1, 4, True), "Depth": (0, 2, False),
    "Opaque": (0.001, 0.8, True), "BlockOpaque": (0, 2, False), "Most": (0.1, 0.99, False), "Faint": (0.2, 8, True), "BlockFaint": (0, 1.2, False),
}
# Indoors a camera behind a wall sees nothing else, and a room whose Gaussians are elsewhere is blurred beyond recognition; a view of
# an object that is close or far stays so.
BOUNDS_OF = {"indoor": {"Distance": (0.6, 1.1, True), "Second": (0.6, 2.5, True), "Third": (0.6, 1.5, True), "Behind": (0.02, 4.5, True),
                        "Clumps": (0, 1.7, False), "Size": (0.25, 1.8, True)},
             "object": {view: (0.6, 1.4, True) for view in ("Distance", "Second", "Third")}}
WITHIN = 0.1
# Of logarithms: what is near enough, how far beyond that a ratio's loss is half of the most that it can have, and how far a share
# that is nearly 0 may be off.
NEAR, HALF, FARTHEST = 0.07, 0.1, 1.5
DIFFERENCE = 0.06  # of a parameter's range, to estimate how ratios follow it
DIGITS = 3


def rounded(value):
    return float(f"{value:.{DIGITS}g}")


class Range:
    """The parameters that are fitted, each as a number of 0 to 1."""

    def __init__(self, kind, start, only):
        self.start = start
        self.bounds = {**BOUNDS, **BOUNDS_OF.get(kind, {})}
        # What is not there is left out: a share of 0 has no logarithm.
        self.names = [name for name in start if name in (only or self.bounds) and (start[name] > 0 or not self.bounds[name][2])]

    def parts(self):
        return np.array([self._part(name) for name in self.names])

    def _part(self, name):
        low, high, is_log = self.bounds[name]
        value = min(max(self.start[name], low), high)
        return math.log(value / low) / math.log(high / low) if is_log else (value - low) / (high - low)

    def values(self, parts):
        """All parameters, rounded as the source has them."""
        found = dict(self.start)
        for name, part in zip(self.names, parts):
            low, high, is_log = self.bounds[name]
            found[name] = rounded(low * (high / low) ** part if is_log else low + part * (high - low))
        return found


class Fitted:
    """A scene of the set whose ratios are measured with any parameters."""

    def __init__(self, name, jobs):
        self.jobs = jobs
        self.kind, size = name.rsplit("-", 1)
        self.real = benchmark_match.LIKE[name].statistics(os.path.join(scenes.ROOT, "build", "benchmark-match"))
        self.what = [what for what in self.real if what not in ("covered", "filled")]
        self.tools = queue.SimpleQueue()
        for _ in range(jobs):
            tool = subprocess.Popen(["splat-benchmark", self.kind, str(scenes.SIZES[size])], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
            self.built_in = json.loads(tool.stdout.readline())
            self.tools.put(tool)

    def measured(self, values, seed):
        """Logarithms of the ratios."""
        tool = self.tools.get()
        tool.stdin.write(json.dumps({"seed": seed, "parameters": values}) + "\n")
        tool.stdin.flush()
        made = benchmark_match.pooled(json.loads(tool.stdout.readline()))
        self.tools.put(tool)
        return np.array([min(max(math.log(max(made[what], 1e-9) / self.real[what]), -FARTHEST), FARTHEST) for what in self.what])

    def ratios(self, choices, seeds):
        """Of each choice of parameters the mean over the seeds."""
        with concurrent.futures.ThreadPoolExecutor(self.jobs) as pool:
            found = list(pool.map(lambda one: self.measured(*one), [(values, seed) for values in choices for seed in seeds]))
        return np.mean(np.array(found).reshape(len(choices), len(seeds), -1), axis=1)


def beyond(ratios):
    return ratios - np.clip(ratios, -NEAR, NEAR)


def losses(ratios):
    """Of each ratio at most 1, so that one that cannot be reached does not pull at the others."""
    square = (beyond(ratios) / HALF) ** 2
    return np.sum(square / (1 + square) + 0.05 * np.abs(ratios), axis=-1)


def loss(ratios):
    return float(losses(ratios))


def within(ratios):
    return int(np.sum(np.abs(np.exp(ratios) - 1) <= WITHIN))


def step_of(ratios, follows, parts, region, random):
    """The change of the parameters that minimizes the predicted loss within the region: the loss has many valleys, so a search by
    random changes, which costs nothing here."""
    low, high = np.maximum(-region, -parts), np.minimum(region, 1 - parts)
    step, best, spread = np.zeros(len(parts)), loss(ratios), 0.5 * region
    for _ in range(200):
        changed = random.random((100, len(parts))) < random.uniform(0.1, 1)
        tried = np.clip(step + changed * random.normal(0, spread, (100, len(parts))), low, high)
        found = losses(ratios + tried @ follows.T)
        at = int(np.argmin(found))
        if found[at] < best:
            step, best = tried[at], found[at]
        else:
            spread = max(0.8 * spread, 0.01 * region)
    return step


def fit(of, span, evaluations, seeds, say):
    parts = span.parts()
    ratios, = of.ratios([span.values(parts)], seeds)
    say(0, ratios, span.values(parts))
    follows, used, region, stuck, random = None, 1, 0.15, 0, np.random.default_rng(1)
    while used < evaluations:
        if follows is None:
            # By one seed: differences of the same random numbers have little noise.
            changes = np.diag(np.where(parts < 0.5, DIFFERENCE, -DIFFERENCE))
            base, *others = of.ratios([span.values(parts + change) for change in (np.zeros(len(parts)), *changes)], seeds[:1])
            follows, stuck = ((np.array(others) - base) / np.diag(changes)[:, None]).T, 0
            used += len(parts) / len(seeds)
        step = step_of(ratios, follows, parts, region, random)
        if not np.any(step):
            break
        found, = of.ratios([span.values(parts + step)], seeds)
        used += 1
        follows = follows + np.outer(found - ratios - follows @ step, step) / (step @ step)
        if loss(found) < loss(ratios):
            parts, ratios, region, stuck = parts + step, found, min(1.5 * region, 0.3), 0
            say(used, ratios, span.values(parts))
        else:
            region, stuck = 0.5 * region, stuck + 1
            if stuck == 4:
                follows, region = None, 0.08
    return span.values(parts), ratios


def initializer(values):
    return "{" + ", ".join(f".{name} = {value:g}" for name, value in values.items()) + "}"


def main():
    parser = argparse.ArgumentParser(description="Parameters of the benchmark set, fitted to real scenes")
    parser.add_argument("scene", choices=benchmark_match.LIKE, metavar="SCENE")
    parser.add_argument("--evaluations", type=int, default=100, metavar="N", help="of all seeds (default 100)")
    parser.add_argument("--seeds", type=int, default=1, metavar="N", help="scenes that are made of each choice of parameters (default 1); the set has the first")
    parser.add_argument("--only", nargs="+", choices=BOUNDS, metavar="NAME", help="parameters that are fitted (default: all)")
    parser.add_argument("--start", metavar="FILE", help="parameters to begin with, as JSON (default: those of the build)")
    parser.add_argument("--jobs", type=int, default=1, metavar="N", help="evaluations at a time (default 1)")
    parser.add_argument("--out", default=os.path.join(scenes.ROOT, "build", "benchmark-fit"), metavar="FOLDER")
    args = parser.parse_args()
    if not scenes.known():
        parser.error("no ../shared/data, expected real scenes there")
    os.makedirs(args.out, exist_ok=True)
    of = Fitted(args.scene, args.jobs)
    start = of.built_in
    if args.start:
        with open(args.start, encoding="utf-8") as file:
            start.update(json.load(file))
    span = Range(of.kind, start, args.only)

    def say(used, ratios, values):
        print(f"{used:.0f} evaluations: loss {loss(ratios):.3f}, {within(ratios)} of {len(ratios)} within {100 * WITHIN:.0f} %", flush=True)
        with open(os.path.join(args.out, args.scene + ".json"), "w", encoding="utf-8") as file:
            json.dump(values, file, indent=1)

    values, _ = fit(of, span, args.evaluations, list(range(args.seeds)), say)
    by_seed = [np.exp(of.measured(values, seed)) for seed in range(args.seeds)]
    print(initializer(values))
    for k, what in enumerate(of.what):
        print(f"{what}: " + " ".join(f"{ratios[k]:.2f}" for ratios in by_seed))


if __name__ == "__main__":
    command_line.run(main)
