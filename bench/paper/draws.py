"""Every claim of the clock on machines, methods and views that are drawn at random, so that a verdict has its uncertainty."""

import dataclasses
import functools
import json
import os
import statistics
from dataclasses import dataclass

import claims
import hypercube
import invocations
import joint
import lines
import machines
import priors
import runs as r
import scaling
import scenes
import speedup
import tails
import timed_frame
import uncertainty
import verdicts
from runs import Run
from writing import paragraph, table

TITLE = "Draws"
COUNT, SEED = 60, 1
# Of the benchmark set, and the one of the paper's size, of whose frame the figures are.
SCENES = tuple(f"{kind}-{size}" for size in ("100k", "1m") for kind in scenes.KINDS)
TARGET = "1m"
LIST_SCALES = (0.5, 1, 2)  # of the width, in analyses, which have no clock
SLOW = 100  # MHz
# Where a crop of a view begins, in parts of the picture that is left beside it, and what part of each side it takes.
CROPS = ((0.5, 0.5), (0, 0.5), (1, 0.5), (0.5, 1))
CROP_SIDES = (0.2, 0.35)
TILE = 64
# Our kernels in the tiles and groups that are fastest or near it (choices.py), and INRIA's.
BASELINES = {"fastest": ("--path", "simt", "--tile", "16", "--simt-group", "16"), "official": speedup.OFFICIAL}
Z_PARTS = "2"  # of all numbers of parts the least work beyond one list's (depth.py)
# By what the time of a stage is taken to grow: counts of a frame.
GROWS_BY = {"project": "gaussians", "sort by depth": "visible", "count pairs": "visible", "duplicate": "pairs", "sort by tile": "pairs",
            "blend": "work"}
# What a draw has beside the table of factors: which view in which size, which crop of it, the error of the sample, and for counts
# of lists another size, and a reach.
SHAPE = {what: ("workload", what) for what in ("place", "crop", "sampling", "size", "reach")}


@dataclass(frozen=True)
class Frame(Run):
    """A frame on a machine with the values of a draw, as JSON."""
    draw: str = ""
    settings: str = "{}"

    def name(self):
        return f"draw{self.draw}-{super().name()}"

    def config(self):
        return _merged(super().config(), json.loads(self.settings))

    @staticmethod
    def trimmed(report):
        return summary(report)


def _merged(base, more):
    return {**base, **{key: _merged(base.get(key, {}), value) if isinstance(value, dict) else value for key, value in more.items()}}


def summary(report):
    """What the figures are computed from: milliseconds of stages with the parts of their time (uncertainty.py), and counts."""
    counters, counts = report["total"]["counters"], report["counts"]
    found = {"gaussians": r.gaussians(report), "visible": counts["visible"], "pairs": counts["pairs"],
             "blends": counters.get("raster_blends", 0), "fragments": counters.get("raster_fragments", 0),
             # A lane slot each, and a cycle of all lanes for a Gaussian's box.
             "work": counters.get("raster_fragments", 0) / 16 + counters.get("raster_gaussians", 0),
             "lane_slots": counters.get("raster_gaussians", 0) * TILE * TILE}
    if timed := report.get("time"):
        found["stages"] = {stage["name"]: _stage(stage) for stage in timed["stages"] if stage["of_the_frame"]}
        found["busy"], found["on_lists"] = tails.busy(report), tails.on_lists(report)
        found["time"] = {"sum": {"clock_version": timed["sum"]["clock_version"]}}
    return found


def _stage(stage):
    run = stage.get("time")
    return {"host_ms": stage["launch_ms"] + stage["copy_ms"], "ms": run["cycles"] / run["clock_mhz"] / 1e3 if run else 0,
            "shares": dict(uncertainty.shares(run)) if run else {}}


@functools.cache
def _clock_domains(machine):
    """Domains of the values of a machine of isasim/configs; a changed number of rasterizers or channels changes none."""
    return priors.of_clock(timed_frame.machine(os.path.join(scenes.ROOT, machines.FOLDER, machine + ".json"))["timing"])


@dataclass(frozen=True)
class Place:
    """A view of a scene in a size, and the scene of whose view of that name the figures are, or None for this one."""
    of: scenes.Scene
    scene: scenes.Scene
    view: str
    target: scenes.Scene = None


# Of the factors that are no values of the clock, what is taken where nothing is drawn.
AS_IT_IS = {("machine", "core"): "vortex-5stage", ("machine", "raster.queue_depth"): 4, ("method", "support"): "exact", ("method", "exp"): "exact",
            ("method", "baseline"): "fastest", ("method", "pipeline"): "serial", **{factor.key: 100 for factor in priors.in_group("part")}}


@dataclass(frozen=True)
class Draw:
    """parts: of 0 to 1 by factor, or None for everything as it is but for `fixed`."""
    number: str
    place: Place
    crop: int
    parts: dict = None
    fixed: dict = None

    def value(self, group, name):
        """Of a factor that is no value of the clock."""
        if not self.parts:
            return {**AS_IT_IS, **(self.fixed or {})}[group, name]
        return hypercube.value_at(priors.BY_KEY[group, name].domain, self.parts[group, name])

    @property
    def baseline(self):
        return self.value("method", "baseline")

    @property
    def pipeline(self):
        return self.value("method", "pipeline")

    @property
    def drawing(self):
        return ("--path", "raster", "--support", self.value("method", "support"), "--exp", self.value("method", "exp"))

    @property
    def counting(self):
        """Those that counts depend on."""
        return ("--path", "raster", "--support", self.value("method", "support"))

    @property
    def kernels(self):
        """The options of the kernels alone."""
        own = () if self.baseline == "official" else ("--support", self.value("method", "support"))
        return (*BASELINES[self.baseline], *own)

    @property
    def factors(self):
        return {factor.name: self.value("part", factor.name) for factor in priors.in_group("part")}

    @property
    def prototype(self):
        core = self.value("machine", "core")
        return next(name for name in machines.PROTOTYPES if machines.parameters(name)["timing"]["core"]["preset"] == core)

    @property
    def scene(self):
        return self.place.scene

    def settings(self, machine):
        """Those of a machine of isasim/configs."""
        if not self.parts:
            return {}
        timing = {}
        for (group, name), domain in _clock_domains(machine).items():
            timing.setdefault(group, {})[name] = hypercube.value_at(domain, self.parts[group, name])
        return {"timing": timing, "raster": {"queue_depth": self.value("machine", "raster.queue_depth")}}

    def frame(self, machine, options, like=None, clock=0, scene=None):
        return Frame(scene or self.scene, self.place.view, machine, options, clock, draw=self.number, settings=json.dumps(self.settings(like or machine)))

    def frames(self, folder):
        """Every frame of the draw that needs the clock, by what it shows."""
        prototype, scaled = self.prototype, machines.SCALED[self.prototype]
        return {
            "frame": self.frame(prototype, self.drawing),
            "kernels": self.frame(prototype, self.kernels, scene=cropped(self.scene, self.place.view, self.crop, folder)),
            "slow": self.frame(prototype, self.drawing, clock=SLOW),
            "scaled": self.frame(scaled, self.drawing),
            "channels": self.frame(machines.changed(scaled, timing__dram__channels=scaling.CHANNELS), self.drawing, scaled),
            "one": self.frame(machines.changed(scaled, clusters=1, sockets_per_cluster=1), self.drawing, scaled),
            "handed": self.frame(prototype, (*self.drawing, "--pixel-unit", tails.QUARTER)),
            "parted": self.frame(scaled, (*self.drawing, "--ztiles", Z_PARTS)),
        }

    def counted(self, folder):
        """Frames without the clock, for their counts: of the view, of its crop, of the kernels' lists and of the target."""
        crop = cropped(self.scene, self.place.view, self.crop, folder)
        found = {"whole": counts_run(self.scene, self.place.view, self.counting), "crop": counts_run(crop, self.place.view, self.counting),
                 "lists": counts_run(self.scene, self.place.view, self.kernels)}
        if target := self.place.target:
            found["target"] = counts_run(target, self.place.view, self.counting)
        return found

    def analysed(self):
        """The view's lists in a size and with a reach that are drawn: the point, the support and the size."""
        support, scale = (choices[int(self.parts[SHAPE[what]] * len(choices))]
                          for what, choices in (("reach", invocations.SUPPORTS), ("size", LIST_SCALES)))
        return invocations.point(self.place.of, self.place.view, round(camera_of(self.scene, self.place.view)["width"] * scale)), support


def counts_run(scene, view, options):
    return Frame(scene, view, machines.PROTOTYPES[0], options, None, draw="counts")


def camera_of(scene, view):
    with open(os.path.join(scenes.ROOT, scene.cameras), encoding="utf-8") as f:
        return next(camera for camera in json.load(f) if camera["img_name"] == view)


def cropped(scene, view, number, folder):
    """A scene whose cameras have of the view a part of whole tiles, by its principal point."""
    camera = camera_of(scene, view)
    size = camera["width"], camera["height"]
    sides = [max(TILE, round(side * part / TILE) * TILE) for side, part in zip(size, CROP_SIDES)]
    begin = [max(0, int((whole - side) * at / TILE) * TILE) for whole, side, at in zip(size, sides, CROPS[number])]
    camera.update(cx=camera.get("cx", size[0] / 2) - begin[0], cy=camera.get("cy", size[1] / 2) - begin[1], width=sides[0], height=sides[1])
    os.makedirs(folder, exist_ok=True)
    file = os.path.join(folder, f"{scene.name}-{view}-crop{number}.json")
    with open(file, "w", encoding="utf-8") as f:
        json.dump([camera], f)
    return scenes.Scene(f"{scene.name}-crop{number}", scene.path, os.path.relpath(file, scenes.ROOT), (view,))


def drawn(places, count, seed=SEED):
    """The draws: each place as often as another."""
    clock = {key for machine in machines.NAMED for key in _clock_domains(machine)}
    keys = [*SHAPE.values(), *(factor.key for factor in priors.FACTORS if factor.group in priors.GROUPS), *sorted(clock)]
    for number, parts in enumerate(hypercube.parts(keys, count, seed, priors.CORRELATIONS)):
        yield Draw(f"{number:02}", places[int(parts[SHAPE["place"]] * len(places))], int(parts[SHAPE["crop"]] * len(CROPS)), parts)


class Times:
    """Milliseconds of a frame's stages with the draw's factors, for another frame with more of what stages grow by."""

    def __init__(self, found, factors, grown=None):
        self.stages = {name: stage["ms"] * uncertainty.longer(stage["shares"], factors) * (grown or {}).get(name, 1)
                       for name, stage in found["stages"].items()}
        self.host = sum(stage["host_ms"] for stage in found["stages"].values())

    @property
    def kernels(self):
        return sum(self.stages.values())

    def frame(self, pipeline):
        """As runs.overlapped_ms() has it."""
        blend = self.stages["blend"]
        return self.host + (self.kernels if pipeline == "serial" else max(blend, self.kernels - blend))


def growth(own, target):
    """How many times as long each stage takes for a frame with other counts."""
    return {stage: target[by] / own[by] for stage, by in GROWS_BY.items() if own[by]}


def kernels_times(frame, kernels, counts, factors, grown, blend_grown):
    """The frame by kernels alone: its blending as in the crop, by blends and times blend_grown, and the rest as with the rasterizer,
    by the lists."""
    rest = growth(counts["whole"], {**counts["whole"], "pairs": counts["lists"]["pairs"]})
    times = Times(frame, factors, {stage: grown.get(stage, 1) * rest[stage] for stage in rest})
    crop = Times(kernels, factors).stages["blend"]
    times.stages["blend"] = crop * counts["whole"]["blends"] / counts["crop"]["blends"] * blend_grown
    times.host = Times(kernels, factors).host
    return times


# Where a sample may be off, each corrected by itself: on the prototype, on the scaled machines, and in crops.
KERNELS = "blending by kernels"
PARTS_OF = {kind: {part: f"{kind}: {part}" for part in ("blending", "the rest")} for kind in ("prototype", "scaled")}
SCALED_KINDS = ("scaled", "channels", "one", "parted")


@dataclass(frozen=True, eq=False)
class Sampled:
    """What was found of a draw. found, counts: summaries by what they show; off: by what times are multiplied of what may be off."""
    draw: Draw
    found: dict
    counts: dict
    off: dict

    @functools.cached_property
    def growth(self):
        return growth(self.counts["whole"], self.counts["target"]) if "target" in self.counts else {}

    def grown(self, what):
        """How many times as long each stage of a frame takes for the target."""
        if "target" not in self.counts:
            return {}
        parts = PARTS_OF["scaled" if what in SCALED_KINDS else "prototype"]
        return {stage: times * self.off.get(parts["blending" if stage == "blend" else "the rest"], 1) for stage, times in self.growth.items()}

    def times(self, what):
        if what == "kernels":
            return kernels_times(self.found["frame"], self.found["kernels"], self.counts, self.draw.factors, self.grown("frame"),
                                 self.growth.get("blend", 1) * self.off.get(KERNELS, 1))
        return Times(self.found[what], self.draw.factors, self.grown(what))

    def ms(self, what, pipeline=None):
        return self.times(what).frame(pipeline or self.draw.pipeline)

    def blend(self, what):
        return self.times(what).stages["blend"]

    @property
    def mcycles(self):
        """The part of a frame that scales with the clock, of two clocks."""
        return (self.ms("slow", "serial") - self.ms("frame", "serial")) / (1e3 / SLOW - 1e3 / joint.CLOCK)


def _joint(s):
    return sum(FIGURES[key][1](s) >= least for key, least in
               (("fps", joint.FPS), ("slow_fps", joint.SLOW_FPS), ("times", joint.TIMES[0]), ("gain", joint.SCALED_GAIN)))


# Of each claim (claims.py) the frames that its figure needs, and the figure.
FIGURES = {
    "fps": (("frame",), lambda s: 1e3 / s.ms("frame")),
    "slow_fps": (("slow",), lambda s: 1e3 / s.ms("slow")),
    "figure_fps": (("slow",), lambda s: 1e3 / s.ms("slow")),
    "scaled_fps": (("scaled",), lambda s: 1e3 / s.ms("scaled")),
    "clocks": (("frame", "slow"), lambda s: s.ms("slow", "serial") / s.ms("frame", "serial")),
    "mcycles": (("frame", "slow"), lambda s: s.mcycles),
    "fixed_ms": (("frame", "slow"), lambda s: s.ms("frame", "serial") - s.mcycles * 1e3 / joint.CLOCK),
    "blend_share": (("frame", "kernels"), lambda s: 100 * s.blend("kernels") / s.times("kernels").kernels),
    "times": (("frame", "kernels"), lambda s: s.ms("kernels", "serial") / s.ms("frame")),
    "blending": (("frame", "kernels"), lambda s: s.blend("kernels") / s.blend("frame")),
    "lanes": (("frame",), lambda s: 100 * s.found["frame"]["blends"] / s.found["frame"]["lane_slots"]),
    "gain": (("frame", "scaled"), lambda s: s.ms("frame") / s.ms("scaled")),
    "linear": (("one", "scaled"), lambda s: s.blend("one") / s.blend("scaled")),
    "memory": (("scaled", "channels"), lambda s: 100 * (s.ms("scaled", "serial") / s.ms("channels", "serial") - 1)),
    "quarter_gain": (("frame", "handed"), lambda s: 100 * (s.blend("frame") / s.blend("handed") - 1)),
    "quarter": (("frame", "handed"), lambda s: 100 * (s.found["frame"]["on_lists"] - s.found["handed"]["on_lists"]) / s.found["frame"]["busy"]),
    "ztiles": (("scaled", "parted"), lambda s: s.blend("scaled") / (s.blend("parted") + s.times("parted").stages.get("merge", 0))),
    "joint": (("frame", "slow", "scaled", "kernels"), _joint),
    # What the page says of a frame, and no claim.
    "not_blending": (("frame",), lambda s: 100 * (1 - s.blend("frame") / s.ms("frame", "serial"))),
}


def figures(sampled):
    """Of each of FIGURES whose frames were measured."""
    return {key: make(sampled) for key, (needs, make) in FIGURES.items() if all(what in sampled.found for what in needs)}


def factors_of(draw):
    """What a draw has of each named factor, and which part of its range of each other value."""
    named = {".".join(key): draw.value(*key) for key, factor in priors.BY_KEY.items()}
    return {**named, **{".".join(key): part for key, part in draw.parts.items() if key not in priors.BY_KEY and key[0] != "workload"}}


def lists_figures(store, draw):
    """The figures of the claims about lists, of an analysis without a machine."""
    point, support = draw.analysed()
    try:
        found = store.measured([point])[0]["report"]
    except r.Missing as missing:
        store.left_out.append(str(missing))
        return {}
    pairs = found["invocations_by_support"][support]
    return {"invocations": 100 * (1 - pairs["64"] / pairs["16"]), "occlusion": 100 * found["lists"]["64"]["occluded_by_percent"][75]}


def places_of(store, some, widths):
    """The first view of each scene, at each width; of the target the view of the same name, as it is."""
    folder = os.path.join(store.folder, "cameras")
    return [Place(scene, scenes.at_width(scene, width, folder) if width else scene, scene.views[0], target) for scene, target in some
            for width in widths or (0,)]


def measure(store, some, widths=(), count=COUNT):
    """Draws of the first view of each scene, at each width or as it is. some: scenes, each with the one that its figures are of, or
    None for its own."""
    folder = os.path.join(store.folder, "cameras")
    places = places_of(store, some, widths)
    wanted = [(draw, draw.frames(folder), draw.counted(folder)) for draw in drawn(places, count)]
    store.prepare([run for _, _, counted in wanted for run in counted.values()])
    for what in wanted[0][1]:  # one kind after the other: where it is broken off, some claims have all of their draws
        store.prepare([frames[what] for _, frames, _ in wanted])
    checks = check(store, places, folder)
    corrections = {of: correction([c for c in checks if c["of"].startswith(of)]) for of in (KERNELS, *PARTS_OF["prototype"].values(), *PARTS_OF["scaled"].values())}
    rows = []
    for draw, frames, counted in wanted:
        found, counts = store.those_there(frames), store.those_there(counted)
        if len(counts) < len(counted):
            continue
        # Where in its range an error is, that of a crop by where in the crop's own part of 0 to 1 the draw is.
        at = {of: draw.parts[SHAPE["crop"]] * len(CROPS) % 1 if of == KERNELS else draw.parts[SHAPE["sampling"]] for of in corrections}
        sampled = Sampled(draw, found, counts, {of: factor * spread ** (2 * at[of] - 1) for of, (factor, spread) in corrections.items()})
        rows.append({"number": draw.number, "scene": draw.scene.name, "of": draw.place.of.name, "view": draw.place.view, "gaussians": counts["whole"]["gaussians"],
                     "figured_gaussians": counts.get("target", counts["whole"])["gaussians"], "machine": draw.prototype, "factors": factors_of(draw),
                     "figures": {**figures(sampled), **lists_figures(store, draw)}})
    return {"rows": rows, "count": count, "seed": SEED, "targets": sorted({p.target.name for p in places if p.target}), "corrections": corrections,
            "off": max(spread for of, (_, spread) in corrections.items() if of != KERNELS), "checks": checks}


def correction(checks):
    """By what a sampled time is multiplied so that it is right in the mean of the checks, and within what factor it is then."""
    ratios = [c["ours"] / c["whole"] for c in checks]
    middle = statistics.geometric_mean(ratios) if ratios else 1
    return 1 / middle, max([1.0, *(max(ratio / middle, middle / ratio) for ratio in ratios)])


def check(store, places, folder):
    """How far sampled frames are off on the machine as it is: blending by kernels in each crop beside the whole frame, in the smallest
    place, and frames that are scaled to their targets beside these. A row for each that is there."""
    rows = []
    first = places[0]
    for baseline in BASELINES:
        for crop in range(len(CROPS)):
            draw = Draw("asis", first, crop, fixed={("method", "baseline"): baseline})
            frames = {what: frame for what, frame in draw.frames(folder).items() if what in ("frame", "kernels")}
            found, counts = store.those_there(frames), store.those_there(draw.counted(folder))
            whole = store.those_there({"whole": draw.frame(draw.prototype, draw.kernels)})
            if len(found) == 2 and whole and {"whole", "crop", "lists"} <= set(counts):
                counts.pop("target", None)
                rows.append({"of": f"{KERNELS}, {baseline}", "from": f"crop {crop} of {first.scene.name}",
                             "ours": Sampled(draw, found, counts, {}).blend("kernels"), "whole": Times(whole["whole"], draw.factors).stages["blend"]})
    for place in places:
        for core in priors.BY_KEY["machine", "core"].domain if place.target else ():
            draw = Draw("asis", place, 0, fixed={("machine", "core"): core})
            counts = store.those_there(draw.counted(folder))
            for kind, what, machine in (("prototype", "frame", draw.prototype), ("scaled", "scaled", machines.SCALED[draw.prototype])):
                target = dataclasses.replace(draw, place=Place(place.target, place.target, place.view))
                both = store.those_there({what: draw.frame(machine, draw.drawing), "target": target.frame(machine, draw.drawing)})
                if len(both) == 2 and {"whole", "target"} <= set(counts):
                    ours, whole = Sampled(draw, both, counts, {}).times(what), Times(both["target"], draw.factors)
                    for part, of in (("blending", lambda t: t.stages["blend"]), ("the rest", lambda t: t.kernels - t.stages["blend"])):
                        rows.append({"of": PARTS_OF[kind][part], "from": f"{place.scene.name} on `{machine}`", "ours": of(ours), "whole": of(whole)})
    return rows


def _range(factor):
    if isinstance(factor.domain, list):
        return ", ".join(f"`{choice}`" if isinstance(choice, str) else str(choice) for choice in factor.domain)
    return "{:g} to {:g}".format(*factor.domain)


def text(data):
    out = [paragraph(f"""Verdicts with their uncertainty. Each of {len(data["rows"])} draws is a view, a machine and a way to measure: every choice of ours has a
        prior, and is drawn by a Latin hypercube. Each of as many equal parts of a factor's range is used once (seed {data["seed"]}), and factors that
        follow each other are put in such an order (Iman and Conover). A claim is computed within a draw, from frames of the same machine."""), ""]
    out += ["## Claims", "", paragraph("""5 %, median and 95 % of the draws, in how many a claim holds, and Wilson's interval of that share.
        *Follows*: the factors with the strongest rank correlation with the figure, beyond chance at 99 %."""), ""]
    rows = []
    for claim, trials in claims.of_draws(data):
        values, held = [trial.value for trial in trials], claims.held(claim, trials)
        follows = ", ".join(f"`{name}` {value:+.2f}" for value, name in lines.followed(data, claim.key)[:4])
        rows.append((claim.words, claim.paper, verdicts.interval_text(values, claim.unit), verdicts.share_text(held, len(values), "draws"),
                     f"**{verdicts.verdict(held, len(values))}**", follows))
    out += table(("claim", "paper", "ours", "holds in", "verdict", "follows"), rows)
    out += ["## By level", "", "In how many draws a claim holds, by what decides most between machines and ways to measure.", ""]
    levels = [(factor, level) for factor, of in lines.SPLIT.items() for level in of]
    splits = lines.splits(data)
    out += table(("claim", *(lines.SPLIT[factor][level] for factor, level in levels), *_scenes(data)),
                 [(claim.words, *("{} of {}".format(*splits[claim.key][factor][level]) for factor, level in levels), *_by_scene(data, claim))
                  for claim, _ in claims.of_draws(data)])
    out += ["## What is drawn", "", paragraph("""Of choices in a list each is as likely as another; between two ends the logarithm is even. `bench/priors.py` is the
        table's source, and `bench/uncertainty.py` draws a frame's time by it."""), ""]
    out += table(("factor", "from", "unit", "why"), [(f"`{'.'.join(f.key)}`", _range(f), f.unit, f.grounds) for f in priors.FACTORS]
                 + [("view", ", ".join(sorted({row["scene"] for row in data["rows"]})), "", "each as often as another"), (priors.RULE, "", "", "no source states them")])
    out += ["Rank correlations; everything else is independent:", ""]
    out += table(("factor", "and", "correlation", "why"), [(f"`{'.'.join(a)}`", f"`{'.'.join(b)}`", value, why) for a, b, value, why in priors.CORRELATED])
    out += ["## How a frame is sampled", "", paragraph(f"""Kernels alone are measured on one of {len(CROPS)} crops of a view, {CROP_SIDES[0]:g} of its width and {CROP_SIDES[1]:g} of its height in whole
        tiles, which is drawn, too. Their blending grows by blends, and the rest of their frame is the rasterizer's, with the lists that they need.
        Where the figures are of a larger frame, each stage grows by a count of both frames, without the clock."""), ""]
    out += table(("stage", "grows by"), [(stage, {"work": "lane slots / 16 and Gaussians fetched"}.get(by, by)) for stage, by in GROWS_BY.items()])
    if data["checks"]:
        said = "; ".join(f"{of} times {factor:.2f}, then within a factor of {spread:.2f}" for of, (factor, spread) in data["corrections"].items() if spread > 1)
        out += ["## How far a sample is off", "", paragraph(f"""The machine as it is, milliseconds: sampled, and the whole frame. Draws are corrected by the mean of these, and what is left is
            drawn, too: {said}."""), ""]
        out += table(("of", "from", "sampled", "whole", "off"), [(c["of"], c["from"], f"{c['ours']:.2f}", f"{c['whole']:.2f}", f"{100 * (c['ours'] / c['whole'] - 1):+.1f} %")
                                                                 for c in data["checks"]])
    return out


def _scenes(data):
    return sorted({row["of"] for row in data["rows"]})


def _by_scene(data, claim):
    of = {scene: [row["figures"][claim.key] for row in data["rows"] if row["of"] == scene and claim.key in row["figures"]] for scene in _scenes(data)}
    return [f"{sum(map(claim.good, values))} of {len(values)}" for values in of.values()]


def charts(_data):
    return {}
