"""Which view, resolution, baseline and machine meets the paper's rendering figures together."""

from speedup import BASELINES
from writing import mega, paragraph, table

TITLE = "All at once"
FPS, SLOW_FPS, TIMES, SCALED_GAIN = 19, 6.4, (30.2, 38.4), 8.0
CLOCK = 530  # MHz
# What they imply for a frame at that clock.
FRAME_MCYCLES = CLOCK / FPS
KERNELS_MCYCLES = tuple(FRAME_MCYCLES * times for times in TIMES)
SHARE = 1 - 1 / TIMES[0]
PIPELINES = ("serial", "overlapped")


def rows_of(rates, speedup):
    """A row for each view, machine, baseline and pipeline of which all was measured: the four figures, and which of them
    are met."""
    against = {(row["scene"], row["view"], row["machine"]): row for row in speedup["rows"]}
    rows = []
    for rate in rates["rows"]:
        row = against.get((rate["scene"], rate["view"], rate["machine"]))
        for baseline in BASELINES if row else ():
            for pipeline in PIPELINES if row[baseline] else ():
                of = rate[pipeline]
                figures = {"fps": of["fps"], "slow_fps": of["slow_fps"], "times": row[baseline][pipeline], "gain": of["gain"]}
                least = {"fps": FPS, "slow_fps": SLOW_FPS, "times": TIMES[0], "gain": SCALED_GAIN}
                rows.append({"scene": rate["scene"], "view": rate["view"], "machine": rate["machine"],
                             "baseline": baseline, "pipeline": pipeline, **figures,
                             "met": [key for key in least if figures[key] >= least[key]],
                             "frame_cycles": rate["frame_cycles"], "kernels_cycles": row[baseline]["frame_cycles"],
                             "share": row[baseline]["blend_share"]})
    return rows


def off(row):
    """The factor within which all four figures are the paper's; its range of times counts as one figure."""
    within = min(max(row["times"], TIMES[0]), TIMES[1])
    pairs = ((row["fps"], FPS), (row["slow_fps"], SLOW_FPS), (row["times"], within), (row["gain"], SCALED_GAIN))
    return max(max(ours / paper, paper / ours) for ours, paper in pairs)


def text(rates, speedup):
    """What the combinations say together; their table is a page of its own."""
    rows = rows_of(rates, speedup)
    all_met = [row for row in rows if len(row["met"]) == 4]
    said = [f"Of {len(rows)} combinations {len(all_met)} meet all four" + (": " + _names(all_met) if all_met else "") + "."]
    for baseline, named in BASELINES.items():
        if of := [row for row in rows if row["baseline"] == baseline]:
            nearest = min(of, key=off)
            said.append(f"Over {named}, the nearest to the paper is {_names([nearest])}: each of the four figures is within a "
                        f"factor of {off(nearest):.2f} of the paper's.")
    said = " ".join(said)
    out = [paragraph(f"""The paper's rates, {FPS} frames/s at {CLOCK} MHz and {SLOW_FPS} at 100 MHz, its {TIMES[0]} times over kernels
        alone and the {SCALED_GAIN} times of the scaled machine are of one machine and, as far as the text says, of one workload.
        Together they imply {FRAME_MCYCLES:.1f} Mcycles a frame with two rasterizers, {KERNELS_MCYCLES[0]:.0f} to
        {KERNELS_MCYCLES[1]:.0f} Mcycles by kernels alone, and that over {100 * SHARE:.1f} % of those are blending.
        *official*: the baseline that is the official algorithm, step by step."""), "", said, ""]
    return [*out, "[Each combination](paper/joint.md) has a row.", ""]


def page(rates, speedup):
    rows = rows_of(rates, speedup)
    out = [f"# {TITLE}", "", paragraph("""[The paper's results](../paper-results.md#against-kernels). Made by `scripts/paper.sh`; do not
        edit. A row has a prototype, and the scaled machine with the same core. A figure that is met is bold. *official*: the
        baseline that is the official algorithm, step by step."""), ""]
    lines = []
    for row in rows:
        def cell(key, shown, row=row):
            return f"**{shown}**" if key in row["met"] else shown
        lines.append((row["scene"], row["view"], f"`{row['machine']}`", row["baseline"], row["pipeline"],
                      cell("fps", f"{row['fps']:.1f}"), cell("slow_fps", f"{row['slow_fps']:.1f}"),
                      cell("times", f"{row['times']:.1f}x"), cell("gain", f"{row['gain']:.2f}x"), len(row["met"]),
                      mega(row["frame_cycles"]), f"{row['kernels_cycles'] / 1e6:.0f}", f"{100 * row['share']:.1f} %"))
    lines.append(("paper", "", "", "", "", str(FPS), str(SLOW_FPS), f"{TIMES[0]}x", f"{SCALED_GAIN}x", "",
                  f"{FRAME_MCYCLES:.1f}", f"{KERNELS_MCYCLES[0]:.0f}-{KERNELS_MCYCLES[1]:.0f}", f"{100 * SHARE:.1f} %"))
    return out + table(("scene", "view", "machine", "baseline", "pipeline", f"frames/s at {CLOCK}", "at 100", "over kernels",
                        "scaled", "met", "frame, Mcycles", "by kernels", "of it blending"), lines)


def _names(rows):
    return "; ".join(f"{row['scene']} {row['view']} on `{row['machine']}`, {row['baseline']}, {row['pipeline']}" for row in rows)
