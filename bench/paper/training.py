"""Training: iterations with the rasterizer and by kernels alone, by stage, by clock and by rasterizers."""

import dataclasses
import json
import math
import os
import random
import statistics
import struct
from dataclasses import dataclass

import benchmark_capture
import machines
import runs as r
import scaling
import scenes
import study
from writing import chart, mega, paragraph, table, terms

TITLE = "Training"
# Options, and by what pictures are divided: the state is trained at the first, and iterations are timed at all.
CAPTURES = {
    "chair_synthetic": (("--background", "1,1,1"), (4, 2, 1)),
    "carving_colmap": ((), (4,)),
    "desk_colmap": (("--exclude", "input_0001"), (4,)),
}
# A capture with so many points to begin with, at its smallest size, of which no kernels are timed: rates follow the number of
# Gaussians. The state is that after a few iterations, because the clock hardly depends on how far a training is.
MANY = {"carving_colmap-600000": ("carving_colmap", 600_000, 10)}
# Gaussians of the benchmark set's garden, beside photographs of the largest at the size of the paper's Train, as if trained up to
# INRIA's first evaluation point: nobody has to train them. An iteration of each is timed.
MADE = {"garden-100k": 100_000, "garden-600k": 600_000, "garden-1m": 1_000_000}
MADE_OF, MADE_AFTER = "outdoor-1m", 7050
DEFAULT_CAPTURES = (*MADE, "chair_synthetic", "carving_colmap", *MANY)
SHARED = os.path.join("..", "shared", "data", "captures")
TIMED = 3  # iterations after the state, each of another view; at a capture's larger sizes one, which takes as long
# The kernels' choices of tile and group. The way back has groups of 16 whatever the way forward has, and keeps a tile in local
# memory, for which larger ones are too large.
CHOICES = ((8, 16), (8, 64), (16, 64), (16, 256))
# Other baselines than sums in a fixed order, with the tiles and groups that are tried. Both have a work-item a pixel, also on the
# way back: INRIA's program has tiles of 16x16 and adds each pixel to memory; DISTWAR and gsplat add up the pixels of a warp before.
OTHER_SUMS = {"atomics": ((16, 256),), "warp": ((8, 16), (16, 256))}
ONLY_SMALLEST = ("atomics",)  # which takes too long at a capture's larger sizes
PAPER_SPEEDUP = (51, 58.4)
CLOCKS = (100, 530)
RASTERIZERS = 1024
LARGEST = scaling.grown(RASTERIZERS)
FULL = (7000, 30000)  # iterations of a training: INRIA's two evaluation points
# Sums of a pixel and Gaussian that INRIA's way back adds to memory, one atomic each: colour, mean, conic, opacity.
ATOMICS = 9
PARTS = {
    "project": ("project",),
    "sort": ("sort by depth", "count pairs", "duplicate", "sort by tile"),
    "blend": ("blend",),
    "loss": ("resolve", "loss", "upstream"),
    "blend backward": ("blend backward",),
    "reduce": ("reduce",),
    "project backward": ("project backward",),
    "Adam": ("views' sum", "Adam"),
    "density control": ("density control",),
}
RASTERIZED = ("blend", "blend backward")


def is_written(name):
    """False for one of MADE whose photographs nobody has drawn yet."""
    return name not in MADE or os.path.exists(os.path.join(scenes.ROOT, benchmark_capture.folder_of(MADE_OF)))


@dataclass(frozen=True)
class Capture:
    name: str
    source: str   # where it is
    path: str     # what is trained from
    options: tuple
    scales: tuple
    after: int = 0  # iterations before those that are timed; 0: as many as for other captures
    made: str = ""  # the scene that a state is made from, if it is not trained

    @classmethod
    def named(cls, name, folder):
        """One of CAPTURES, MANY or MADE, or any folder; what has to be written for it goes into `folder`."""
        if name in MADE:
            photographs = benchmark_capture.captured(MADE_OF)
            scene = scenes.written("outdoor", MADE[name], name).path
            return cls(name, photographs, photographs, ("--max-gaussians", str(MADE[name])), (1,), MADE_AFTER, scene)
        if name in MANY:
            of, points, after = MANY[name]
            one = cls.named(of, folder)
            path = one.path if not one.is_there() else os.path.relpath(
                _with_points(one.source, os.path.join(folder, "captures", name), points), scenes.ROOT)
            return dataclasses.replace(one, name=name, path=path, after=after,
                                       options=(*one.options, "--max-gaussians", str(points)))
        if name not in CAPTURES:
            path = os.path.abspath(name)
            return cls(os.path.basename(os.path.normpath(name)), path, path, (), (1,))
        source, (options, scales) = os.path.join(SHARED, name), CAPTURES[name]
        if not os.path.exists(os.path.join(scenes.ROOT, source, "transforms_test.json")):
            return cls(name, source, source, options, scales)
        path = os.path.relpath(_with_one_held_out(source, os.path.join(folder, "captures", name)), scenes.ROOT)
        return cls(name, source, path, (*options, "--allow-outside"), scales)

    def is_there(self):
        return os.path.isdir(os.path.join(scenes.ROOT, self.source))


def _with_one_held_out(source, folder):
    """Links to a NeRF-synthetic capture with one picture to hold out: scoring all of them at the end of a run takes
    longer than the iterations that are timed, and is in no time."""
    source = os.path.join(scenes.ROOT, source)
    first = min(os.listdir(os.path.join(source, "test")))
    os.makedirs(os.path.join(folder, "test"), exist_ok=True)
    for part in ("transforms_train.json", "transforms_test.json", "train", os.path.join("test", first)):
        link = os.path.join(folder, part)
        if not os.path.lexists(link):
            os.symlink(os.path.realpath(os.path.join(source, part)), link)
    return folder


def _with_points(source, folder, count):
    """Links to a capture of COLMAP with `count` points: the capture's own, in turn, each a little aside."""
    source = os.path.join(scenes.ROOT, source)
    os.makedirs(os.path.join(folder, "sparse"), exist_ok=True)
    for part in ("images", os.path.join("sparse", "cameras.bin"), os.path.join("sparse", "images.bin")):
        link = os.path.join(folder, part)
        if not os.path.lexists(link):
            os.symlink(os.path.realpath(os.path.join(source, part)), link)
    with open(os.path.join(source, "sparse", "points3D.bin"), "rb") as file:
        data = file.read()
    own, at = [], 8
    for _ in range(struct.unpack_from("<Q", data)[0]):
        _, *place, red, green, blue, error, track = struct.unpack_from("<Q3d3BdQ", data, at)
        own.append((place, (red, green, blue)))
        at += struct.calcsize("<Q3d3BdQ") + 8 * track
    middle = [statistics.median(place[k] for place, _ in own) for k in range(3)]
    aside = 0.1 * statistics.median(math.dist(place, middle) for place, _ in own)
    drawn = random.Random(1)
    with open(os.path.join(folder, "sparse", "points3D.bin"), "wb") as file:
        file.write(struct.pack("<Q", count))
        for n in range(count):
            place, colour = own[n % len(own)]
            moved = [x + (drawn.gauss(0, aside) if n >= len(own) else 0) for x in place]
            file.write(struct.pack("<Q3d3BdQ", n + 1, *moved, *colour, 0, 0))
    return folder


@dataclass(frozen=True)
class State:
    """A training run without clock whose checkpoint others begin with. It goes on where it was broken off."""
    capture: Capture
    iterations: int
    folder: str

    def name(self):
        return r.file_name([self.capture.name, "train", str(self.iterations)])

    def words(self, kept, out):
        return ("splat", "train", self.capture.path, *self.capture.options, "--downscale", str(self.capture.scales[0]), "--iterations",
                str(self.iterations), "--checkpoint", kept + ".checkpoint", "--checkpoint-every", "50", "--resume", "-o", out + ".ply",
                "--json", out + ".json")

    def point(self):
        return study.Point(self.name(), self.words("{kept}", "{out}"), {"capture": self.capture.source},
                           {"VORION_CONFIG": json.dumps(machines.config(self.machine))}, (".checkpoint",), any_build=True)

    def checkpoint(self):
        return os.path.relpath(study.file_of(self.folder, self.point(), ".checkpoint"), scenes.ROOT)

    def command(self):
        return " ".join(self.words(self.checkpoint().removesuffix(".checkpoint"), "out"))

    @property
    def machine(self):
        return machines.PROTOTYPES[0]

    @staticmethod
    def trimmed(report):
        return report


@dataclass(frozen=True)
class Made(State):
    """A checkpoint that is made from a scene."""

    def words(self, kept, out):
        return "splat-checkpoint", self.capture.made, str(self.iterations), kept + ".checkpoint", out + ".json"

    def point(self):
        return study.Point(self.name(), self.words("{kept}", "{out}"), {"scene": self.capture.made}, {}, (".checkpoint",), any_build=True)


@dataclass(frozen=True)
class Timed:
    """The iterations after a state, on a machine with its clock on: TIMED at the state's own size."""
    state: State
    scale: int  # by which pictures are divided
    machine: str
    options: tuple
    clock: int = 0  # MHz; 0: the machine's own

    def iterations(self):
        # Three reports of as many cores as LARGEST has are more than a file of JSON may be.
        many = not self.state.capture.made and self.scale == self.state.capture.scales[0] and "--simt-sums" not in self.options and self.machine != LARGEST
        return TIMED if many else 1

    def name(self):
        return r.file_name([self.state.name(), f"by{self.scale}", self.machine, *self.options, *([f"{self.clock}MHz"] if self.clock else [])])

    def words(self, state, out):
        capture = self.state.capture
        return ("splat", "train", capture.path, *capture.options, "--downscale", str(self.scale), "--from", state,
                "--iterations", str(self.state.iterations + self.iterations()), "--time", "--time-every", "1", "--energy", *self.options,
                "-o", out + ".ply", "--json", out + ".json")

    def point(self):
        return study.Point(self.name(), self.words("{state}", "{out}"), {"capture": self.state.capture.source, "state": self.state.checkpoint()},
                           {"VORION_CONFIG": json.dumps(self.config())})

    def config(self):
        config = machines.config(self.machine)
        if self.clock:
            config.setdefault("timing", {})["clock_mhz"] = self.clock
        return config

    def command(self):
        setting = f"VORION_SET=timing.clock_mhz={self.clock} " if self.clock else ""
        return f"{setting}VORION_CONFIG={machines.shown(self.machine)} " + " ".join(self.words(self.state.checkpoint(), "out"))

    @staticmethod
    def trimmed(report):
        for sample in report["timed"]:
            r.trim(sample["time"])
            sample["energy"] = {key: sample["energy"][key] for key in ("technology", "volts", "chip_joules")}
        report.pop("losses")
        return report


def raster(state, scale, machine, clock=0):
    return Timed(state, scale, machine, ("--path", "raster"), clock)


def simt(state, scale, machine, choice):
    return Timed(state, scale, machine, ("--path", "simt", "--tile", str(choice[0]), "--simt-group", str(choice[1])))


def summed(state, scale, machine, sums, choice):
    """The kernels with other sums than those in a fixed order."""
    kernels = simt(state, scale, machine, choice)
    return dataclasses.replace(kernels, options=(*kernels.options, "--simt-sums", sums))


def mean(result, of):
    """Over the timed iterations."""
    return statistics.fmean(of(sample) for sample in result["timed"])


def parts_of(result):
    """Mean cycles by part of an iteration, in the order of PARTS."""
    return {part: mean(result, lambda s, names=names: sum(r.stage_cycles(s, name) for name in names))
            for part, names in PARTS.items()}


def megabytes(result, stages=None):
    """What an iteration, or some stages of it, reads and writes in DRAM."""
    burst = result["timed"][0]["time"]["sum"]["host"]["dram_burst_bytes"]

    def bursts(sample):
        return sum(s["time"]["dram"]["read_bursts"] + s["time"]["dram"]["write_bursts"] for s in sample["time"]["stages"]
                   if "time" in s and s["of_the_frame"] and (stages is None or s["name"] in stages))

    return burst * mean(result, bursts) / 1e6


def blends_back(result):
    """Pixels of Gaussians that the rasterizers' way back goes through."""
    return mean(result, lambda sample: sum(k["counters"]["raster_blends"] for s in sample["stages"]
                                           if s["name"] == "blend backward" for k in s["kernels"]))


def summary(result):
    parts = parts_of(result)
    cycles = sum(parts.values())
    return {"parts": parts, "cycles": cycles, "ms": mean(result, r.frame_ms), "dram_mb": megabytes(result),
            "backward_mb": megabytes(result, ("blend backward", "reduce")),
            # What the rasterizer's way back takes the place of: with atomics there would be no sum over tiles.
            "backward": parts["blend backward"] + parts["reduce"],
            "command": result["command"]}


def compared(with_it, without):
    """A row of the table; without: results of the kernels by choice, and where there are none the row says nothing of them."""
    ours = summary(with_it)
    row = {"ours": ours, "clock_mhz": with_it["timed"][0]["time"]["sum"]["clock_mhz"],
           "gaussians": with_it["timed"][0]["gaussians"], "its": 1e3 / ours["ms"],
           "pairs": mean(with_it, lambda sample: sum(sample["list_lengths"])), "blends_back": blends_back(with_it),
           "command": with_it["command"], "kernels": bool(without)}
    if not without:
        return row
    tried = [{"tile": choice[0], "group": choice[1], **summary(result)} for choice, result in without.items()]
    back = min(tried, key=lambda row: row["backward"])
    whole = min(tried, key=lambda row: row["ms"])
    share = (whole["parts"]["blend"] + whole["backward"]) / whole["cycles"]
    rest = ours["ms"] * (1 - sum(ours["parts"][part] for part in RASTERIZED) / ours["cycles"])
    return {**row, "tried": tried, "kernels_back": back, "kernels_whole": whole,
            "back_speedup": back["backward"] / ours["backward"], "speedup": whole["ms"] / ours["ms"], "share": share,
            "bound": 1 / (1 - share), "bound_rest": whole["ms"] / rest,
            "accumulation_share": back["backward"] / back["cycles"]}


def largest(result):
    """Milliseconds of an iteration on the largest machine: both stages of the rasterizers, all other work, and what launches
    and copies take."""
    clock = result["timed"][0]["time"]["sum"]["clock_mhz"]
    rasterizers = mean(result, lambda sample: sum(r.stage_cycles(sample, name) for name in RASTERIZED))
    return {"rasterizers_ms": rasterizers / clock / 1e3,
            "kernels_ms": (mean(result, r.frame_cycles) - rasterizers) / clock / 1e3,
            "host_ms": mean(result, lambda s: s["time"]["launch_ms"] + s["time"]["copy_ms"]),
            "tiles": len(result["timed"][0]["list_lengths"])}


def density(trained, result):
    """How often the number of Gaussians may change, and whether it did in the timed iterations after `trained`."""
    counts = {trained["gaussians"], *(sample["gaussians"] for sample in result["timed"])}
    return {"interval": result["run"]["densify"][0], "changed": len(counts) > 1}


def density_text(rows):
    """A sentence of `rows` that say so."""
    rows = [row for row in rows if "density" in row]
    if not rows:
        return ""
    intervals = sorted({row["density"]["interval"] for row in rows})
    changed = [row["scene"] for row in rows if row["density"]["changed"]]
    return (f"The number of Gaussians changes after every {' or '.join(map(str, intervals))} iterations, "
            f"{'in those of ' + ', '.join(changed) if changed else 'not in these'}.")


def _first(result):
    """The first iteration that was timed, alone: that is all that there is of OTHER_SUMS."""
    sample = result["timed"][0]
    return {"cycles": r.frame_cycles(sample), "backward": sum(r.stage_cycles(sample, name) for name in ("blend backward", "reduce")),
            "ms": r.frame_ms(sample), "chip_mj": 1e3 * sample["energy"]["chip_joules"]["value"]}


def beside(with_it, sums, choice, result):
    """The first iteration by kernels, and the same one with the rasterizer."""
    one, ours = _first(result), _first(with_it)
    return {"sums": sums, "tile": choice[0], "group": choice[1], **one, "back_speedup": one["backward"] / ours["backward"],
            "speedup": one["ms"] / ours["ms"], "energy_ratio": one["chip_mj"] / ours["chip_mj"], "command": result["command"]}


def _fastest(row, without):
    """The run of the fastest iteration with ordered sums, if there is one."""
    if not row["kernels"]:
        return {}
    choice = row["kernels_whole"]["tile"], row["kernels_whole"]["group"]
    return {("ordered", choice): without[choice]}


def _on(store, state, scale, prototype, choices):
    """The rows of a prototype, and the result of its raster run on it."""
    with_it, scaled, slow = store.all(
        [raster(state, scale, prototype), raster(state, scale, machines.SCALED[prototype]),
         raster(state, scale, prototype, CLOCKS[0])])
    without = store.those_there({c: simt(state, scale, prototype, c) for c in choices})
    large = summary(scaled)
    is_smallest = scale == state.capture.scales[0]
    others = store.those_there({(sums, c): summed(state, scale, prototype, sums, c) for sums, tried in OTHER_SUMS.items()
                                if choices and (is_smallest or sums not in ONLY_SMALLEST) for c in tried})
    row = compared(with_it, without)
    return {**row, "slow_its": 1e3 / mean(slow, r.frame_ms),
            "slow_command": slow["command"],
            "by_sums": [beside(with_it, *what, result) for what, result in {**_fastest(row, without), **others}.items()],
            "scaled": {"machine": machines.SCALED[prototype], "its": 1e3 / large["ms"], "ms": large["ms"],
                       "clock_mhz": scaled["timed"][0]["time"]["sum"]["clock_mhz"], "command": large["command"]}}, with_it


def row_of(store, capture, scale, iterations):
    """All choices of the kernels are tried at the first scale on the first machine, and those that are fastest there on the
    other and at the other scales."""
    iterations = capture.after or iterations
    state = (Made if capture.made else State)(capture, iterations, store.folder)
    trained, = store.all([state])
    first, *others = machines.PROTOTYPES
    at_first, with_it = _on(store, state, capture.scales[0], first, () if capture.after else CHOICES)
    best, found = () if capture.after else _best(at_first), at_first
    if scale != capture.scales[0]:
        found, with_it = _on(store, state, scale, first, best)
    row = {"scene": capture.name, "view": f"{'x'.join(map(str, with_it['resolution']))} after {iterations}",
           "machines": {first: found}}
    for machine in others:
        try:
            row["machines"][machine] = _on(store, state, scale, machine, best)[0]
        except r.Missing as missing:
            store.left_out.append(str(missing))
    many, = store.all([raster(state, scale, LARGEST)])
    row.update(energy_of={key: with_it["timed"][0]["energy"][key] for key in ("technology", "volts")},
               largest=largest(many), large_of=machines.SCALED[first], density=density(trained, with_it))
    return row


def _best(compared_row):
    """The choices of the fastest way back and of the fastest iteration; all, if none was measured."""
    if not compared_row["kernels"]:
        return CHOICES
    return sorted({(k["tile"], k["group"]) for k in (compared_row["kernels_back"], compared_row["kernels_whole"])})


def by_prototype(data):
    """A row for each of the prototypes and captures."""
    return [{**found, "scene": row["scene"], "view": row["view"], "machine": machine}
            for row in data["rows"] for machine, found in row["machines"].items()]


def measure(store, captures, _every_view, iterations):
    if not captures:
        raise r.Missing("no ../shared/data/captures, expected captures there, or --captures FOLDER")
    places = [(store, capture, f"size/{scale}") for capture in captures for scale in capture.scales]
    rows = store.rows(places, lambda s, capture, size: row_of(s, capture, int(size.split("/")[1]), iterations))
    return {"rows": rows, "energy_of": rows[0]["energy_of"] if rows else None}


def seconds(row, iterations, host):
    """Of so many iterations with RASTERIZERS of them. host: launches and copies too."""
    large = row["largest"]
    return iterations * (large["rasterizers_ms"] + large["kernels_ms"] + (large["host_ms"] if host else 0)) / 1e3


def choices_text(row):
    back, whole = ((row[k]["tile"], row[k]["group"]) for k in ("kernels_back", "kernels_whole"))
    shown = f"{back[0]}/{back[1]}"
    return shown if back == whole else f"{shown}, whole {whole[0]}/{whole[1]}"


def _kernels_cells(m):
    return (mega(m["kernels_whole"]["cycles"]), mega(m["kernels_back"]["backward"]), choices_text(m), f"{100 * m['share']:.1f} %",
            f"{m['bound']:.2f}x", f"{m['bound_rest']:.2f}x", f"{m['back_speedup']:.1f}x", f"{m['speedup']:.2f}x")


def _paths(m):
    """What was measured of a row, by path."""
    return [("rasterizer", m["ours"]), *([("kernels", m["kernels_whole"])] if m["kernels"] else [])]


def of_sums(data, sums, tile):
    """The rows of a way to sum in tiles of a side, by prototype and capture."""
    return [{**m, **one} for m in by_prototype(data) for one in m["by_sums"] if (one["sums"], one["tile"]) == (sums, tile)]


def _within(rows, key):
    """Between what the ratios lie, and how many of them are the paper's."""
    low, high = PAPER_SPEEDUP
    values = [row[key] for row in rows]
    inside = sum(low <= value <= high for value in values)
    return f"{min(values):.1f} to {max(values):.1f}x ({inside} of {len(values)})"


def _text_of_sums(data):
    rows = [(m, one) for m in by_prototype(data) for one in m["by_sums"]]
    if not rows:
        return []
    technology = "{technology}, {volts:.2f} V".format(**data["energy_of"]) if data.get("energy_of") else ""
    out = ["## Ways to sum gradients by kernels", "",
           *terms([("*ordered*", "tile by tile in a fixed order without atomics: the kernels of the tables above"),
                   ("*atomics*", """what INRIA's program does: a work-item a pixel adds nine sums a Gaussian to memory, by atomics. OpenCL C 1.2
                    has no atomic sum of floats, so each is a loop around a compare-and-exchange, and lanes at the same Gaussian take turns"""),
                   ("*warp*", """the idea of DISTWAR and of gsplat: the 16 pixels of a warp are added up first, and a Gaussian that none of them
                    needs is skipped. Each of nine lanes then adds one sum to memory, by an atomic""")]),
           paragraph(f"""The options are `--path simt --simt-sums` and one of these words. The first iteration after the state, by kernels and with
           the rasterizer. *faster*: how many times faster the rasterizer is. *energy*: of the chip in an iteration, mJ
           ({technology}), and over the rasterizer's."""), ""]
    out += table(("capture", "pictures", "machine", "sums", "tile/group", "iteration, Mcycles", "back, Mcycles", "faster: iteration",
                  "faster: back", "energy, mJ", "energy, times"),
                 [(m["scene"], m["view"], f"`{m['machine']}`", one["sums"], f"{one['tile']}/{one['group']}", mega(one["cycles"]),
                   mega(one["backward"]), f"{one['speedup']:.1f}x", f"{one['back_speedup']:.1f}x", f"{one['chip_mj']:.1f}",
                   f"{one['energy_ratio']:.1f}x") for m, one in rows])
    low, high = PAPER_SPEEDUP
    baselines = dict.fromkeys((one["sums"], one["tile"]) for _, one in rows)
    out += [f"Which of them give the paper's {low} to {high} times (in brackets, how many of the rows do):", ""]
    return out + table(("sums", "tile", "iteration", "back"),
                       [(sums, f"{tile}x{tile}", _within(of, "speedup"), _within(of, "back_speedup"))
                        for sums, tile in baselines for of in [of_sums(data, sums, tile)]])


def text(data):
    rows = data["rows"]
    out = [paragraph(f"""Means of the {TIMED} iterations after so many of a training run (settings of [training.md](../training.md)),
        each of another view. The iterations before them went without the clock, at the smallest of the capture's sizes. The larger
        pictures have the same Gaussians, and one iteration is timed. {density_text(rows)} Tiles of the rasterizer are 32x64. The
        kernels' tile and group are the fastest of {', '.join(f'{t}/{g}' for t, g in CHOICES)} at the first size on
        `{machines.PROTOTYPES[0]}`."""), "",
           *terms([("*back*", """from the pixels' gradients to nine sums a Gaussian: blending backward and the sum over tiles, in a fixed
                    order and without atomics"""),
                   ("*share*", "blending forward and back in the fastest kernels-only iteration"),
                   ("*bound*", "1/(1 - share)"),
                   ("*rest*", "the kernels-only iteration over ours without the stages of the rasterizer")])]
    for machine in machines.PROTOTYPES:
        of = [row for row in by_prototype(data) if row["machine"] == machine]
        if not of:
            continue
        out += [f"## Training on `{machine}`, {of[0]['clock_mhz']} MHz, and on `{machines.SCALED[machine]}`", ""]
        out += table(("capture", "pictures", "Gaussians", "iteration, Mcycles", "it/s", f"it/s at {CLOCKS[0]} MHz", "scaled, it/s",
                      "back, Mcycles", "kernels: iteration", "kernels: back", "tile/group", "share", "bound", "rest", "back",
                      "iteration"),
                     [(m["scene"], m["view"], m["gaussians"], mega(m["ours"]["cycles"]), f"{m['its']:.2f}",
                       f"{m['slow_its']:.2f}", f"{m['scaled']['its']:.2f}", mega(m["ours"]["backward"]),
                       *(_kernels_cells(m) if m["kernels"] else [""] * 8)) for m in of])
    out += _text_of_sums(data)
    out += ["## By stage", "", "Percent of an iteration's cycles.", ""]
    out += table(("capture", "pictures", "machine", "path", *PARTS),
                 [(m["scene"], m["view"], f"`{m['machine']}`", path,
                   *(f"{100 * of['parts'][part] / of['cycles']:.1f}" for part in PARTS)) for m in by_prototype(data)
                  for path, of in _paths(m)])
    out += ["## Bytes and atomics", "",
            "DRAM traffic of an iteration and of its way back.", "",
            *terms([("*atomics avoided*", f"what INRIA's way back adds to memory: {ATOMICS} a pixel and Gaussian"),
                    ("*stores*", f"what the hand-over leaves of them: {ATOMICS} a Gaussian and tile")])]
    out += table(("capture", "pictures", "MB", "kernels: MB", "back, MB", "kernels: back, MB", "atomics avoided, M", "stores, M",
                  "ratio"),
                 [(m["scene"], m["view"], f"{m['ours']['dram_mb']:.2f}", f"{m['kernels_whole']['dram_mb']:.2f}",
                   f"{m['ours']['backward_mb']:.2f}", f"{m['kernels_back']['backward_mb']:.2f}",
                   mega(ATOMICS * m["blends_back"]), mega(ATOMICS * m["pairs"]), f"{m['blends_back'] / m['pairs']:.1f}x")
                  for m in by_prototype(data) if m["machine"] == machines.PROTOTYPES[0] and m["kernels"]])
    out += [f"## {RASTERIZERS} rasterizers", "",
            paragraph(f"""An iteration of `{rows[0]['large_of']}`, and the first one of a machine with {RASTERIZERS} rasterizers, each with four cores. Its memory has
            {scaling.MOST_CHANNELS} channels, the simulator's maximum, with 409.6 GB/s. The last columns are seconds of a training of N such
            iterations, with and without launches and copies."""), ""]
    out += table(("capture", "pictures", "tiles", "scaled, ms", "rasterizers, ms", "kernels, ms", "launches and copies, ms",
                  *(f"{n}: s" for n in FULL), *(f"{n} without: s" for n in FULL)),
                 [(row["scene"], row["view"], row["largest"]["tiles"],
                   f"{row['machines'][machines.PROTOTYPES[0]]['scaled']['ms']:.2f}",
                   f"{row['largest']['rasterizers_ms']:.3f}", f"{row['largest']['kernels_ms']:.3f}",
                   f"{row['largest']['host_ms']:.3f}", *(f"{seconds(row, n, True):.1f}" for n in FULL),
                   *(f"{seconds(row, n, False):.1f}" for n in FULL)) for row in rows])
    return out


def charts(data):
    first = machines.PROTOTYPES[0]
    rows = [(f"{row['scene'].split('_')[0]} {row['view'].split()[0]} {path}", of) for row in data["rows"]
            for path, of in _paths(row["machines"][first])]
    return {"training": chart("An iteration by stage, prototype", "stage", "percent of the cycles", list(PARTS),
                              {name: [100 * of["parts"][part] / of["cycles"] for part in PARTS] for name, of in rows},
                              bars=True)}
