#!/usr/bin/env python3
"""How well the benchmark set matches real scenes: lists, occlusion, blends and alpha, as a table.

usage: bench/benchmark_match.py [--scenes NAME...] [--out FOLDER]
Needs `splat` on the path (scripts/env.sh), scenes in ../shared/data, and numpy for those that are merged ones. FOLDER (default
build/benchmark-match) keeps each analysis (docs/studies.md). Statistics are over all views of a scene together: of tiles whose
list is not empty, of pixels that blend, of pixels whose list is not empty, of all blends.
"""

import argparse
import math
import os

import command_line
import merged_scene
import scenes
import study

SIZE = "980x545"
# Of the picture and not of a pixel: what a scene has beside what is drawn of it.
COVERS = ("covered", "filled")


class Real:
    """What a scene of the set is like: a scene beside the repository, or what follows from some."""

    def __init__(self, of, views=None, merged=1):
        self.of, self.views, self.merged = of, views, merged

    def words(self):
        return self.of + (f", {self.merged} merged to one" if self.merged > 1 else "")

    def scene(self, folder):
        scene = scenes.shared(self.of)
        if self.merged > 1:
            path = merged_scene.merged(scene.path, self.merged, os.path.join(folder, "scenes"))
            scene = scenes.Scene(f"{self.of}-merged", os.path.relpath(path, scenes.ROOT), scene.cameras, scene.views)
        return scenes.Scene(scene.name, scene.path, scene.cameras, self.views or scene.views)

    def statistics(self, folder):
        return pooled(reports(self.scene(folder), folder))


class Trend:
    """What follows for a larger number from a scene in two sizes: powers of the number of Gaussians; of shares of the covered
    pixels, their odds; and what is covered stays as it is."""

    def __init__(self, small, large, gaussians):
        self.small, self.large, self.gaussians = small, large, gaussians

    def words(self):
        return f"the trend of {self.small} and {self.large}"

    def statistics(self, folder):
        (few, a), (many, b) = ((found[0]["scene"]["gaussians"], pooled(found))
                               for found in (reports(scenes.shared(name), folder) for name in (self.small, self.large)))
        times = math.log(self.gaussians / many) / math.log(many / few)
        out = {}
        for what, value in b.items():
            if what in ("covered", "filled"):
                out[what] = value
            elif what.startswith("saturated"):
                odds = [math.log(s[what] / (s["covered"] - s[what])) for s in (a, b)]
                out[what] = b["covered"] / (1 + math.exp(-(odds[1] + times * (odds[1] - odds[0]))))
            else:
                out[what] = value * (value / a[what]) ** times
        return out


LIKE = {
    # From outside, where its view far is, it is no room.
    "indoor-10k": Real("room7k_sh3", ("front", "close")), "indoor-100k": Real("showroom_indoor", merged=7),
    "indoor-1m": Real("showroom_indoor"),
    "outdoor-10k": Real("truck", merged=12), "outdoor-100k": Real("truck"), "outdoor-1m": Real("garden_outdoor"),
    "object-10k": Real("playbot_small_sh2"), "object-100k": Real("playbot_sh2"),
    "object-1m": Trend("playbot_small_sh2", "playbot_sh2", 1_000_000),
}


def reports(scene, folder):
    """The analyses of a scene's views, lists and supports by boxes of three deviations."""
    points = [study.Point(f"{scene.name}-{view}", ("splat", "analyze", "{scene}", "--cameras", "{cameras}", "--view", view, "--size",
                                                   SIZE, "--support", "box3", "--json", "{out}.json"),
                          {"scene": scene.path, "cameras": scene.cameras}) for view in scene.views]
    return [result["report"] for result in study.measure(points, folder)]


def _spread(parts):
    """Mean, median and 95th percentile of distributions together, each known by its percentiles."""
    count = sum(part["count"] for part in parts)
    if not count:
        return 0, 0, 0
    points = sorted((value, part["count"] / len(part["percentiles"])) for part in parts for value in part["percentiles"])
    found, below = {}, 0
    for value, weight in points:
        below += weight
        for percent in (50, 95):
            if percent not in found and below >= count * percent / 100:
                found[percent] = value
    return sum(part["mean"] * part["count"] for part in parts) / count, found[50], found[95]


def pooled(views):
    """The statistics of some views together, by name."""
    out = {}
    spreads = {"list of 16 pixels": [v["lists"]["16"]["filled"] for v in views],
               "list of 64 pixels": [v["lists"]["64"]["filled"] for v in views],
               "alpha": [v["alpha"] for v in views], "blends": [v["blends"] for v in views], "walked": [v["walked"] for v in views]}
    for what, parts in spreads.items():
        for name, value in zip(("mean", "median", "95 %"), _spread(parts)):
            out[f"{what}, {name}"] = value
    for percent in (25, 50, 75, 100):
        out[f"saturated at {percent} %"] = sum(v["lists"]["16"]["occluded_by_percent"][percent] for v in views) / len(views)
    out["covered"] = sum(v["covered_share"] for v in views) / len(views)
    out["filled"] = sum(v["lists"]["16"]["filled"]["count"] / v["lists"]["16"]["tiles"] for v in views) / len(views)
    return out


def figure(value):
    return f"{value:.0f}" if value >= 100 else f"{value:.1f}" if value >= 10 else f"{value:.3f}"


def main():
    parser = argparse.ArgumentParser(description="The benchmark set beside real scenes")
    parser.add_argument("--scenes", nargs="+", choices=LIKE, default=list(LIKE), metavar="NAME")
    parser.add_argument("--out", default=os.path.join(scenes.ROOT, "build", "benchmark-match"))
    args = parser.parse_args()
    if not scenes.known():
        parser.error("no ../shared/data, expected real scenes there")
    columns = {}
    for name in args.scenes:
        made = scenes.generated(name)
        columns[name] = pooled(reports(made, args.out)), LIKE[name].statistics(args.out)
    print("Of each: the real scene, the generated one, and their ratio.\n")
    print("| | " + " | ".join(f"{name}: {LIKE[name].words()}" for name in columns) + " | within 10 % |")
    print("|---|" + "---|" * len(columns) + "--:|")
    first = next(iter(columns.values()))[0]
    matched = dict.fromkeys(columns, 0)
    for what in first:
        cells, good = [], 0
        for name, (made, real) in columns.items():
            ratio = made[what] / real[what] if real[what] else math.nan
            within = abs(ratio - 1) <= 0.1
            good += within
            matched[name] += within and what not in COVERS
            cells.append(f"{figure(real[what])} {figure(made[what])} {ratio:.2f}")
        print(f"| {what} | " + " | ".join(cells) + f" | {good} of {len(columns)} |")
    print(f"| within, of {len(first) - len(COVERS)} without {' and '.join(COVERS)} | " + " | ".join(map(str, matched.values())) + " | |")


if __name__ == "__main__":
    command_line.run(main)
