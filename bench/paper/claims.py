"""What the paper says, by group, and the figures of ours beside it: of a section's views, or of the draws (draws.py)."""

import math
from dataclasses import dataclass
from typing import Callable

import clocks
import energy
import joint
import machines
import scaling
import speedup
import tails
import training
from verdicts import Trial, about, at_least, below, place

# Its rates at 100 MHz are less than the text's, and 3.6 is 19 x 100 / 530. docs/tables/prior-art.md says from where we have it.
FIGURE_9 = "as the paper's figure 9 has it"
# Pictures that differ by less, differ by rounding (colours are around 1).
ROUNDING = 1e-5
GROUPS = ("rates", "against kernels", "scaling", "tiles and occlusion", "mechanisms", "accuracy", "power and area", "training")
LAST = training.CLOCKS[-1]
FULL = training.FULL[0]


@dataclass(frozen=True)
class Claim:
    """A claim of the paper, in short and in words. section: which measures it; trials: of that section's data, one for each view and kind.
    good: whether a value keeps to it; number: the paper's, for the ratio; rate: whether it needs a workload of the paper's size."""
    key: str
    short: str
    group: str
    words: str
    paper: str
    section: str
    trials: Callable
    good: Callable
    unit: str = ""
    number: float = 0
    rate: bool = False

    @property
    def less_is_easier(self):
        """Whether a smaller workload keeps to it if a larger one does: of a bound, not of "about"."""
        return self.good(0) or self.good(math.inf)


# A rate is a workload's: of fewer Gaussians it says nothing about the paper's, which had about a million.
LARGE = 500_000


def _of(rows, value, kind="", machine="machine", command="command"):
    return [Trial(value(row), place(row), kind, row.get(machine, ""), row.get(command, ""), row.get("gaussians", 0)) for row in rows]


def _rates(key, machine="machine", command="command"):
    """A rate of each pipeline."""
    return lambda data: [t for p in joint.PIPELINES for t in _of(data["rows"], lambda row, p=p: row[p][key], p, machine, command)]


def _baselines(data):
    """The rows that have a baseline, with what it is called."""
    return [(baseline, named, [row for row in data["rows"] if row[baseline]]) for baseline, named in speedup.BASELINES.items()]


def _share(data):
    return [t for b, named, rows in _baselines(data) for t in
            [Trial(100 * row[b]["blend_share"], place(row), named, row["machine"], row[b]["command"]) for row in rows]]


def _times(data):
    return [Trial(row[b][p], place(row), f"{named}, {p}", row["machine"], row[b]["command"])
            for b, named, rows in _baselines(data) for p in joint.PIPELINES for row in rows]


def _blending(data):
    return [Trial(row[b]["blending"], place(row), named, row["machine"], row[b]["command"]) for b, named, rows in _baselines(data) for row in rows]


def _lanes(data):
    """Counts of the picture, the same on both machines."""
    return _of([row for row in data["rows"] if row["machine"] == data["rows"][0]["machine"]], lambda row: 100 * row["lane_use_unclipped"],
               machine="")


def _indoors(data):
    return [row for row in data["rows"] if row["scene"] == tails.SCENES[0]] or data["rows"]


def _quarter(row):
    return next(point for point in row["points"] if point["rule"] == tails.QUARTER)


def _depth_gains(data):
    scaled = data["machines"][1]

    def cycles(row):
        return row["cycles"][scaled]["blend"] + row["cycles"][scaled]["merge"]

    found = []
    for row in (row for row in data["rows"] if row["parts"] == 1 and scaled in row["cycles"]):
        best = min((other for other in data["rows"] if place(other) == place(row) and other["parts"] > 1 and scaled in other["cycles"]), key=cycles)
        found.append(Trial(cycles(row) / cycles(best), place(row), f"K = {best['parts']}", scaled, best["command"]))
    return found


def _depth_error(data):
    """Of each view the largest difference, with and without a stop."""
    found = []
    for stop, named in (("no stop", "lists that are not stopped early"), ("stop", "lists that stop when a pixel is full")):
        by_place = {}
        for row in data["rows"]:
            if row["stop"] == stop:
                by_place.setdefault(place(row), []).append(row)
        worst = [max(rows, key=lambda row: row["max_abs"]) for rows in by_place.values()]
        found += [Trial(row["max_abs"], place(row), named, "", row["command"]) for row in worst]
    return found


def _linear(data):
    return [Trial(scaling.at(row, 1)["blend_cycles"] / scaling.at(row, 16)["blend_cycles"], place(row), "", row["machine"], scaling.at(row, 16)["command"])
            for row in data["rows"] if row["parts"] == 1]


def _invocations(data):
    return [Trial(100 * row["fewer"][support][width], place(row), f"`{support}`, {width} px")
            for support in data["rows"][0]["fewer"] for width in map(str, data["widths"]) for row in data["rows"]
            if row["fewer"][support].get(width) is not None]


def _kernels(data):
    return [row for row in training.by_prototype(data) if row["kernels"]]


def _sums(value):
    """Over the kernels that sum in a fixed order, and over others."""
    def trials(data):
        found = _of(_kernels(data), lambda row: row[value], "our fastest kernels")
        for named, sums, tile in (("atomics", "atomics", 16), ("a warp first, tiles of 16", "warp", 16), ("a warp first, tiles of 8", "warp", 8)):
            found += _of(training.of_sums(data, sums, tile), lambda row: row[value], named)
        return found
    return trials


def _iterations(value, command="command"):
    return lambda data: [Trial(value(row), place(row), "", row["machine"], row.get(command, ""), row["gaussians"]) for row in training.by_prototype(data)]


def _forward(data):
    return [Trial(100 * row["kernels_whole"]["parts"]["blend"] / row["kernels_whole"]["cycles"], place(row), "", row["machine"], row["kernels_whole"]["command"])
            for row in _kernels(data)]


def _largest(data):
    return [Trial(training.seconds(row, FULL, True), place(row), "", row["large_of"],
                  row["machines"][machines.PROTOTYPES[0]]["scaled"]["command"], row["machines"][machines.PROTOTYPES[0]]["gaussians"]) for row in data["rows"]]


CLAIMS = (
    Claim("fps", "19 frames/s", "rates", f"{joint.FPS} frames/s at {joint.CLOCK} MHz", f"{joint.FPS}", "rates", _rates("fps"), at_least(joint.FPS),
          number=joint.FPS, rate=True),
    Claim("slow_fps", "6.4 frames/s at 100 MHz", "rates", f"{joint.SLOW_FPS} frames/s at 100 MHz", f"{joint.SLOW_FPS}", "rates", _rates("slow_fps", command="slow_command"),
          at_least(joint.SLOW_FPS), number=joint.SLOW_FPS, rate=True),
    Claim("figure_fps", "3.6 frames/s at 100 MHz", "rates", f"3.6 frames/s at 100 MHz, {FIGURE_9}", "3.6", "rates", _rates("slow_fps", command="slow_command"), at_least(3.6),
          number=3.6, rate=True),
    Claim("scaled_fps", "152 frames/s scaled", "rates", "the scaled machine reaches 152 frames/s", "152", "rates", _rates("scaled_fps", "scaled", "scaled_command"),
          at_least(152), number=152, rate=True),
    Claim("clocks", "2.97 times by the clock", "rates", "530 MHz give 2.97 times the frames of 100 MHz", "2.97x", "clocks",
          lambda data: _of(data["rows"], lambda row: row["fps"][-1] / row["fps"][0]), at_least(joint.FPS / joint.SLOW_FPS), "x",
          joint.FPS / joint.SLOW_FPS),
    Claim("mcycles", "12.8 Mcycles a frame", "rates", "the part of a frame that scales with the clock takes about 12.8 Mcycles", f"{clocks.PAPER_MCYCLES} Mcycles (of the two rates)",
          "clocks", lambda data: _of(data["rows"], lambda row: row["mcycles"]), about(clocks.PAPER_MCYCLES), " Mcycles", clocks.PAPER_MCYCLES, rate=True),
    Claim("fixed_ms", "28.5 ms beside the clock", "rates", "the part that does not takes about 28.5 ms", f"{clocks.PAPER_MS} ms (of the two rates)", "clocks",
          lambda data: _of(data["rows"], lambda row: row["ms"]), about(clocks.PAPER_MS), " ms", clocks.PAPER_MS, rate=True),
    Claim("blend_share", "over 70 % of a frame on kernels is blending", "against kernels", "blending takes over 70 % of a frame on kernels", "> 70 %", "speedup", _share, at_least(70), " %"),
    Claim("times", "30 times the frames of kernels", "against kernels", "30.2 to 38.4 times the frames of 8 cores without rasterizer", "30.2-38.4x", "speedup", _times,
          at_least(joint.TIMES[0]), "x", joint.TIMES[0]),
    Claim("blending", "30 times the blending of kernels", "against kernels", "the same, of blending alone", "30.2-38.4x (read so)", "speedup", _blending, at_least(joint.TIMES[0]), "x",
          joint.TIMES[0]),
    Claim("joint", "four rates at once", "against kernels", f"{joint.FPS} frames/s, {joint.SLOW_FPS} at 100 MHz, {joint.TIMES[0]} times the kernels and "
          f"{joint.SCALED_GAIN} times by the scaled machine, all at once", "4 of 4", "joint", lambda data: _of(data["rows"], lambda row: len(row["met"])),
          at_least(4), " of 4"),
    Claim("lanes", "under 4 % of the lanes without clipping", "against kernels", "without cutting boxes to the tile under 4 % of the lane slots would blend", "0.3-4 % (measured elsewhere)",
          "speedup", _lanes, lambda value: value <= 4, " %"),
    Claim("gain", "8 times by the scaled machine", "scaling", f"the scaled machine is {joint.SCALED_GAIN} times as fast as the prototype (near-linear)", "152 / 19 = 8.0x", "rates",
          _rates("gain", "scaled"), at_least(joint.SCALED_GAIN), "x", joint.SCALED_GAIN),
    Claim("linear", "near-linear to 16 rasterizers", "scaling", "blending scales near-linearly to 16 rasterizers (taken as 80 %)", "near-linear", "scaling", _linear,
          at_least(0.8 * scaling.RASTERIZERS_A_MEMORY), "x", scaling.RASTERIZERS_A_MEMORY),
    Claim("memory", "no limit by memory", "scaling", "the scaled machine is not limited by memory bandwidth (twice as much gives under 5 %)", "not limited", "scaling",
          lambda data: _of(data["memory"], lambda row: 100 * (row["frame_gain"] - 1)), below(5), " % faster"),
    Claim("invocations", "80 % fewer invocations", "tiles and occlusion", "tiles of 64 instead of 16: over 80 % fewer invocations", "> 80 %", "tiles", _invocations, at_least(80),
          " %", 80),
    Claim("occlusion", "90 % of the pixels occluded", "tiles and occlusion", "beyond some depth over 90 % of the pixels are occluded (taken as: by three quarters of the list)", "> 90 %",
          "tiles", lambda data: _of(data["rows"], lambda row: 100 * row["occluded"][75]), at_least(90), " %", 90),
    Claim("pixel_unit", "more by the pixel unit", "mechanisms", "at the best of the hand-over points tried, the pixel unit gives more", "more", "tails",
          lambda data: _of(_indoors(data), lambda row: 100 * (max(p["throughput"] for p in row["points"][1:]) - 1)), lambda value: value > 0, " %"),
    Claim("quarter_gain", "82.4 % more from the last quarter", "mechanisms", "the pixel unit gives 82.4 % more from the last quarter, indoors", "+82.4 %", "tails",
          lambda data: _of(_indoors(data), lambda row: 100 * (_quarter(row)["throughput"] - 1)), at_least(100 * tails.PAPER_GAIN), " %",
          100 * tails.PAPER_GAIN),
    Claim("quarter", "a last quarter of 45.2 %", "mechanisms", "so that the last quarter held 45.2 % of the time", "45.2 %", "tails",
          lambda data: _of(_indoors(data), lambda row: 100 * row["last_quarter_share"]), at_least(45.2), " %", 45.2),
    Claim("ztiles", "more throughput by z-tiling", "mechanisms", "z-tiling gives 16 rasterizers more throughput, merging included", "more parallelism", "depth", _depth_gains,
          lambda value: value > 1, "x"),
    Claim("same", "z-tiling is equivalent", "accuracy", "z-tiling is equivalent to one list", "mathematically equivalent", "depth", _depth_error, lambda value: value <= ROUNDING),
    Claim("accumulation", "over 60 % of an iteration sums gradients", "training", "gradients and their accumulation take over 60 % of an iteration on kernels", "> 60 %", "training",
          lambda data: _of(_kernels(data), lambda row: 100 * row["accumulation_share"]), at_least(60), " %"),
    Claim("forward", "20 % of an iteration blends forward", "training", "rasterization is about 20 % of an iteration on kernels", "20 %", "training", _forward, about(20), " %", 20),
    Claim("train_times", "51 times the iterations of kernels", "training", "51 to 58.4 times the iterations of 8 cores without rasterizer", "51-58.4x", "training", _sums("speedup"), at_least(51),
          "x", 51),
    Claim("back_times", "51 times their backward pass", "training", "the same, of the backward pass alone", "51-58.4x (read so)", "training", _sums("back_speedup"), at_least(51), "x", 51),
    Claim("its", "4.97 iterations/s", "training", f"4.97 iterations/s at {LAST} MHz", "4.97", "training", _iterations(lambda row: row["its"]), at_least(4.97), number=4.97, rate=True),
    Claim("slow_its", "2.43 iterations/s at 100 MHz", "training", f"2.43 iterations/s at {training.CLOCKS[0]} MHz", "2.43", "training",
          _iterations(lambda row: row["slow_its"], "slow_command"), at_least(2.43), number=2.43, rate=True),
    Claim("figure_its", "0.94 iterations/s at 100 MHz", "training", f"0.94 iterations/s at {training.CLOCKS[0]} MHz, {FIGURE_9}", "0.94", "training",
          _iterations(lambda row: row["slow_its"], "slow_command"), at_least(0.94), number=0.94, rate=True),
    Claim("scaled_its", "38.6 iterations/s scaled", "training", "the scaled machine reaches 38.6 iterations/s", "38.6", "training", _iterations(lambda row: row["scaled"]["its"]),
          at_least(38.6), number=38.6, rate=True),
    Claim("seconds", "training in 3 s", "training", f"{training.RASTERIZERS} rasterizers train in under 3 s (taken as {FULL} iterations)", "< 3 s", "training", _largest,
          below(3), " s", 3, rate=True),
)
BY_KEY = {claim.key: claim for claim in CLAIMS}
# Sections that make rows of their own: of estimates with an interval each.
ESTIMATED = {"energy": ("power and area", energy.claims_of)}
# What no section measures, by group: claim, paper, verdict and figure, page.
ELSEWHERE = (
    ("mechanisms", "the intersect bit keeps records in the caches", "fewer accesses", "open", "worth under 0.1 %: without it (`timing.l2.intersect_hint=0`, "
     "`timing.llc.intersect_hint=0`) frames of guitar front, truck overview and garden_outdoor overview change by +0.04, +0.05 and -0.02 %",
     "[the clock](tables/timing.md)"),
    ("mechanisms", "staggered banks", "fewer conflicts", "holds", "worth 0.4 to 1.3 % of a frame: without them (`timing.raster.stagger=0`) these frames take 1.2, 1.3 "
     "and 0.4 % longer", "[the clock](tables/timing.md)"),
    ("mechanisms", "most alphas are below 0.1 or above 0.9", "most", "holds", "by the first alone: of the blends of the scenes that were tried 66 to 91 % are below 0.1, and "
     "at most 0.8 % above 0.9", ""),
    ("accuracy", "the reciprocal's error is within 3 %", "< 3 %", "holds", "3.1 % if the table's entries are spaced by the logarithm; evenly 32 to 55 %; a mantissa "
     "table reaches 1.2e-5", "[reciprocal units](lane-units.md#reciprocal-units)"),
    ("mechanisms", "compatible with ray tracing: alpha blending stays unchanged", "unchanged", "open", "in part: along rays (3DGUT, gsplat's `with_eval3d`) order, thresholds, "
     "stop and colour's sums stay; alpha needs a quotient and 34 % more of a lane, a Gaussian 64 bytes in place of 48, and gradients eight moments in place of five; "
     "surfels, too, with two more and a low pass; blending is 0.04 to 0.34 % of a traced frame's instructions, for which the pixel unit does not pay at any list length, "
     "occlusion or coherence",
     "[rays](tables/unification.md#rays-on-gaussians), [traced](tables/tracing.md#the-pixel-unit)"),
    ("power and area", "minimal hardware change to traditional rasterizers", "minimal", "open", "in gates a rasterizer of Gaussians grows by 5.7 to 13.2 % to draw triangles, "
     "one of triangles to 3.5 times its gates to draw Gaussians", "[unification](unification.md)"),
    ("power and area", "7 % of a lane for gradients", "7 %", "open", "6.4 % in gates if idle multipliers of a pair are reused, without the gather; three adders and three "
     "multipliers are 12.1 %", "[in gates](unification.md#the-backward-mode)"),
)
# What is left open where a section was not measured.
OPEN = {
    "rates": "19 and 6.4 frames/s, 152 and 8.0 times as much on the scaled machine",
    "speedup": "30.2 to 38.4 times the frames of 8 cores without rasterizer",
    "clocks": "how the rates follow the clock",
    "tails": "the pixel unit gives 82.4 % more from the last quarter of the lists, indoors",
    "depth": "z-tiling is equivalent, and gives more parallelism",
    "scaling": "near-linear to 16 rasterizers, and not limited by memory",
    "tiles": "over 80 % fewer invocations with tiles of 64; over 90 % of the pixels are occluded beyond some depth",
    "energy": "under 600 mW, and 1.6 mm2",
    "identical": "the clock, host threads and the machine change no bit of a picture",
    "training": "2.43 to 4.97 iterations/s, 51 to 58.4 times the kernels, 38.6 scaled, under 3 s with 1024 rasterizers",
    "draws": "every verdict with its uncertainty",
}


def of_section(name, data):
    """The claims that a section measures, each with its trials; those without any are left out."""
    found = [(claim, claim.trials(data)) for claim in CLAIMS if claim.section == name and (data.get("rows") or data.get("memory"))]
    return [(claim, trials) for claim, trials in found if trials]


def of_draws(data, least=1):
    """The claims that draws have, each with a trial a draw; those with fewer than `least` are left out."""
    found = [(claim, [Trial(row["figures"][claim.key], place(row), "", row["machine"], "", row["figured_gaussians"]) for row in data["rows"] if claim.key in row["figures"]])
             for claim in CLAIMS]
    return [(claim, trials) for claim, trials in found if len(trials) >= least]


def large_of(claim, trials):
    """The trials that decide: of a rate those whose workload is large enough."""
    return [trial for trial in trials if trial.gaussians >= LARGE] if claim.rate else trials


def held(claim, trials):
    return sum(claim.good(trial.value) for trial in trials)
