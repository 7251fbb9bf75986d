#!/usr/bin/env python3
"""How far a frame's time may be off: its interval when everything that no source gives is drawn at random.

usage: uncertainty.py SCENE --cameras FILE --view NAME --out FOLDER [--config MACHINE] [--samples N] [--seed S] [--raster-only]
       uncertainty.py --parts

What is drawn of values: each of the clock whose source says "ours" (vorion-sim --print-timing-parameters), from half to
twice what it is; words and powers of two among their choices; the link, where the machine has one, the sizes of L2 and
last-level cache, launches and copies in the ranges of bench/priors.py. Other switches stay, because they are choices and
not values.

What is drawn of the model: the switches of the L2 that the RTL has otherwise, and for each part of a frame's time a factor
in the range of what measurements leave open. A part is what units spent on some reasons (docs/time-report.md); --parts
prints the parts, their ranges and the grounds. All are drawn by a Latin hypercube: each of N equal parts of an interval, or
of its logarithm, is used once. Some follow each other, as bench/priors.py says.

Each sample draws the view with the rasterizer and, without --raster-only, with the cores alone. Prints the 5 to 95 %
interval of the times and of their ratio: with drawn values alone, with drawn values and parts, and with drawn parts on the
machine as it is. Also prints the parameters and parts that the time with both follows most (Spearman's rank correlation).
FOLDER keeps each frame (docs/studies.md). Exit codes: 0 done, 1 a frame failed, 2 usage.
"""

import argparse
import collections
import json
import statistics

import clocked
import command_line
import hypercube
import priors
import study
import timed_frame

# The part of each reason. Reasons that are left out are waits for others that work: they follow the rest of their unit.
CORES = {"launch": "launch", "link": "link", "raster_full": "rasterizer", "raster_wait": "rasterizer",
         **dict.fromkeys(("start", "issue", "fetch", "operand", "local", "unit", "slot", "branch", "divergence"), "instructions"),
         **dict.fromkeys(("memory", "lsu_queue", "fence"), "memory")}
RASTERIZERS = {"link": "link", **dict.fromkeys(("blend", "clip", "hazard", "begin", "flush"), "rasterizer"),
               **dict.fromkeys(("fetch", "drain"), "memory")}


def mix(units, parts):
    """Shares of parts in those cycles of units whose reason belongs to a part; none where there are no such cycles."""
    cycles = collections.Counter()
    for unit in units:
        for reason, part in parts.items():
            cycles[part] += unit[reason]
    total = sum(cycles.values())
    return {part: count / total for part, count in cycles.items()} if total else {}


def shares(time):
    """Shares of parts in the time of a run. Cores that wait for rasterizers spend their time as those do."""
    found = collections.Counter(mix(time["cores"], CORES))
    rasterizers = mix(time["rasterizers"], RASTERIZERS)
    if rasterizers:
        waiting = found.pop("rasterizer", 0)
        found.update({part: waiting * share for part, share in rasterizers.items()})
    # Reads send a header to the L2 and get a line, stores the reverse.
    busy = time["link"]["busy_to_l2"], time["link"]["busy_from_l2"]
    found["stores on the link"] = found["link"] * busy[0] / sum(busy) if any(busy) else 0
    found["link"] -= found["stores on the link"]
    return found


def longer(of, factors):
    """How many times longer a run takes of which parts have shares, with factors in percent of its parts."""
    return 1 + sum(share * (factors.get(part, 100) / 100 - 1) for part, share in of.items())


def frame_ms(time, factors):
    """A frame's time from its report, with factors in percent of its parts."""
    total = 0
    for stage in time["stages"]:
        if stage["of_the_frame"]:
            total += stage["launch_ms"] + stage["copy_ms"]
            if run := stage.get("time"):
                total += run["cycles"] / run["clock_mhz"] / 1000 * longer(shares(run), factors)
    return total


def paths_of(args):
    return ("raster",) if args.raster_only else ("raster", "simt")


def points_of(args, default, drawn):
    """Of each sample, one for each path: with the rasterizer, and with the cores alone."""
    of = timed_frame.scene_of(args)
    for number, sample in enumerate(drawn):
        config = json.loads(json.dumps(default))
        for (group, name), value in sample.items():
            if group != "part":
                config["timing"][group][name] = value
        for path in paths_of(args):
            yield study.render(f"{number}-{path}", of, args.view, "--time", "--path", path, VORION_CONFIG=json.dumps(config))


DRAWN = ("values", "values and parts", "parts")


def results_of(paths, drawn, measured):
    """What table() takes of each sample: of each path its times by DRAWN."""
    times = [result["report"]["time"] for result in measured]
    as_it_is = times[:len(paths)]
    for number, sample in enumerate(drawn):
        own = times[len(paths) * number:][:len(paths)]
        factors = {name: value for (group, name), value in sample.items() if group == "part"}
        yield {"values": {".".join(key): value for key, value in sample.items()}, "machine": clocked.name(own[-1]["sum"]),
               **{path: (time["frame_ms"], frame_ms(time, factors), frame_ms(base, factors))
                  for path, time, base in zip(paths, own, as_it_is)}}


def followed(results):
    """(correlation, parameter) of those that the frame's time follows, strongest first: beyond chance at 99 %."""
    found = []
    for name, one in results[0]["values"].items():
        values = [r["values"][name] for r in results]
        if isinstance(one, str) or len(set(values)) == 1:
            continue
        found.append((hypercube.rank_correlation(values, [r["raster"][1] for r in results]), name))
    return sorted((f for f in found if hypercube.is_beyond_chance(f[0], len(results))), key=lambda f: -abs(f[0]))


def interval(values):
    """5 %, median and 95 %."""
    cuts = statistics.quantiles(values, n=20, method="inclusive")
    return cuts[0], statistics.median(values), cuts[-1]


def table(base, results):
    rows = {"frame, rasterizer, ms": lambda r, n: r["raster"][n]}
    if "simt" in base:
        rows |= {"frame, cores alone, ms": lambda r, n: r["simt"][n],
                 "times faster with the rasterizer": lambda r, n: r["simt"][n] / r["raster"][n]}
    print("| | drawn | as it is | 5 % | median | 95 % |\n|---|---|--:|--:|--:|--:|")
    for name, of in rows.items():
        for n, drawn in enumerate(DRAWN):
            print(f"| {name} | {drawn} | " + " | ".join(f"{v:.3g}" for v in (of(base, 0), *interval([of(r, n) for r in results]))) + " |")
    clocked.say([base["machine"]])
    print("\nThe frame's time follows " + (", ".join(
        f"`{name}` ({c:+.2f})" for c, name in followed(results)) or "no single parameter") + ".")


class PrintParts(argparse.Action):
    """As --help: prints and ends, whatever else is given."""

    def __init__(self, **options):
        super().__init__(nargs=0, **options)

    def __call__(self, parser, *_):
        reasons = {"stores on the link": ["cores and rasterizers: `link`, by the share of the link's busy cycles to the L2"]}
        for unit, parts in (("cores", CORES), ("rasterizers", RASTERIZERS)):
            for factor in priors.in_group("part"):
                if of := [f"`{reason}`" for reason, its in parts.items() if its == factor.name]:
                    reasons.setdefault(factor.name, []).append(f"{unit}: {', '.join(of)}")
        print("| part | reasons | true time, % of ours | grounds |\n|---|---|---|---|")
        for factor in priors.in_group("part"):
            low, high = factor.domain
            print(f"| {factor.name} | {'; '.join(reasons[factor.name])} | {low} to {high} | {factor.grounds} |")
        parser.exit()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--parts", action=PrintParts, help="print the parts of a frame's time and their ranges")
    timed_frame.add_view(parser)
    parser.add_argument("--out", required=True, help="folder for the frames")
    parser.add_argument("--jobs", type=int, default=1, help="frames that are drawn at the same time (default: %(default)s)")
    parser.add_argument("--config", help="a machine's name or file; default: the default machine")
    parser.add_argument("--samples", type=int, default=64)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--raster-only", action="store_true", help="leave out the frames of the cores alone")
    args = parser.parse_args()
    if args.samples < 3:
        parser.error(f"--samples is {args.samples}, expected 3 or more")

    default = timed_frame.machine(args.config)
    drawn = [{}, *priors.samples(priors.domains(default["timing"]), args.samples, args.seed)]  # the first is the machine as it is
    base, *results = results_of(paths_of(args), drawn, study.measure(list(points_of(args, default, drawn)), args.out, args.jobs))
    table(base, results)


if __name__ == "__main__":
    command_line.run(main)
