"""Power, area and efficiency of the chip, estimated, by the technology alone and given the published chip (docs/energy.md)."""

import json
import math
import os

import machines
import scenes
from runs import Run
from verdicts import HOLDS, NOT, place
from writing import chart, paragraph, table

TITLE = "Power and area"
# The paper's clocks; which voltages belong to them is ours (docs/energy.md).
CLOCKS = (530, 100)
PAPER_WATTS, PAPER_MM2 = 0.6, 1.6
# What the paper says that gradients add to each pair of lanes, and their share of a lane.
MULTIPLIERS, ADDERS, LANE_SHARE = 3, 3, 0.07
# Of the paper's figure 9: frames/s with two rasterizers, and GauRast's with one of so many mm2 at 28 nm.
PAPER_FPS, GAURAST_FPS, GAURAST_MM2, GAURAST_MHZ, PAPER_EFFICIENCY = 19, 67, 2.43, 1000, 1.7
RASTERIZER = ("rasterizer lanes", "pixel buffers", "rasterizer control", "backward mode")
RASTERIZERS, LANES = 2, 32
OPEN = "open"
with open(os.path.join(scenes.ROOT, "isasim", "energy", "technologies", "16nm.json"), encoding="utf-8") as technology:
    UM2 = {name: row["um2"] for name, row in json.load(technology)["areas"].items()}
# What a claim may be conditioned on: not the figure that it is about.
GIVEN = {"area": "the area", "power": "the power", "area_and_power": "area and power"}


def run(scene, view, machine, clock):
    """With an exponential that a chip would have."""
    return Run(scene, view, machine, ("--exp", "table", "--given-chip"), 0 if clock == CLOCKS[0] else clock)


def measure(store, all_scenes, _every_view):
    places = [(scene, view, m, f"{clock} MHz") for m in machines.PROTOTYPES for clock in CLOCKS for scene in all_scenes
              for view in scene.views]
    store.prepare([run(scene, view, m, clock) for m in machines.PROTOTYPES for clock in CLOCKS for scene in all_scenes
                   for view in scene.views])

    def row(scene, view, machine, at):
        clock = int(at.split()[0])
        result, = store.all([run(scene, view, machine, clock)])
        spent = result["energy"]
        peak = max(spent["stages"], key=lambda stage: stage["chip_watts"]["value"])["name"]
        return {"scene": scene.name, "view": view, "machine": machine, "clock": clock, "volts": spent["volts"],
                "technology": spent["technology"], "fps": result["time"]["fps"], "chip_joules": spent["chip_joules"],
                "joules": spent["joules"], "peak": peak, **figures(spent, peak),
                "given": {key: {**figures(of, peak), "samples": of["samples"], "rows": of["rows"]}
                          for key, of in spent["given_chip"].items()},
                "command": result["command"]}

    return {"rows": store.rows(places, row)}


def figures(spent, stage):
    """What the claims are about."""
    peak, = (of["chip_watts"] for of in spent["stages"] if of["name"] == stage)
    return {"chip_watts": spent["chip_watts"], "peak_watts": peak, "area": spent["area"]}


def estimate(found, scale=1.0):
    value, low, high = (f"{found[key] * scale:.3g}" for key in ("value", "low", "high"))
    return f"{value} ({low}-{high})"


def against(found, most):
    """Whether a figure stays below `most`, by its interval of 90 %."""
    return HOLDS if found["high"] <= most else NOT if found["low"] > most else OPEN


def area_verdict(um2):
    """Whether the interval of 90 % has the paper's area in it."""
    return OPEN if um2["low"] <= PAPER_MM2 * 1e6 <= um2["high"] else NOT


def counted(verdicts):
    """One verdict of all, or how many have each."""
    if len(set(verdicts)) == 1:
        return verdicts[0]
    return ", ".join(f"{kind} on {verdicts.count(kind)}" for kind in (HOLDS, NOT, OPEN) if kind in verdicts) + f" of {len(verdicts)}"


def given(row, condition):
    return row["given"][condition] if condition else row


def part_um2(of, names, end="value"):
    return sum(part["um2"][end] for part in of["area"]["parts"] if part["part"] in names)


def lane_share(of):
    """What multipliers and adders of the backward pass are of a lane, with rows at their medians."""
    factors = {row["row"]: row["factor"]["value"] for row in of.get("rows", ()) if row["of"] == "area"}
    lane = part_um2(of, RASTERIZER[:1]) / LANES
    return (MULTIPLIERS * UM2["fp32 multiplier"] * factors.get("fp32 multiplier", 1)
            + ADDERS * UM2["fp32 adder"] * factors.get("fp32 adder", 1)) / 2 / lane


def efficiency(of, end="value"):
    """The paper's frames a mm2 and MHz of a rasterizer as large as ours, over GauRast's."""
    mm2 = part_um2(of, RASTERIZER, end) / 1e6 / RASTERIZERS
    return PAPER_FPS / RASTERIZERS / mm2 / CLOCKS[0] / (GAURAST_FPS / GAURAST_MM2 / GAURAST_MHZ)


def power_claim(what, all_rows, key, condition):
    """On the technology alone, and given what the claim is not about."""
    rows = [{**row, **given(row, condition)} for row in all_rows]
    found = [row[key] for row in rows]
    prior = counted([against(row[key], PAPER_WATTS) for row in all_rows])
    low, high = (pick(rows, key=lambda row: row[key]["value"]) for pick in (min, max))
    return {"claim": what, "paper": "< 600 mW", "verdict": counted([against(f, PAPER_WATTS) for f in found]),
            "ours": f"{low[key]['value']:.2g} W ({place(low)}, `{low['machine']}`) to {high[key]['value']:.2g} W ({place(high)}, "
            f"`{high['machine']}`), intervals from {min(f['low'] for f in found):.2g} to {max(f['high'] for f in found):.2g}, given {GIVEN[condition]}; "
            f"without: {prior}",
            "ratio": f"{low[key]['value'] / PAPER_WATTS:.2f} to {high[key]['value'] / PAPER_WATTS:.2f}", "bound": "",
            "command": high["command"]}


def claims_of(data):
    fast, slow = ([row for row in data["rows"] if row["clock"] == clock] for clock in CLOCKS)
    out = []
    if fast:
        out += [power_claim(f"under 600 mW at {CLOCKS[0]} MHz, mean of a frame", fast, "chip_watts", "area"),
                power_claim("the same, of the stage with the most power", fast, "peak_watts", "area_and_power")]
    if slow:
        out.append(power_claim(f"under 600 mW at {CLOCKS[1]} MHz, mean of a frame", slow, "chip_watts", "area_and_power"))
    one = (fast or slow)[0]
    by_power, by_area = given(one, "power"), given(one, "area")
    chip = by_power["area"]["chip_um2"]
    out.append({"claim": "cores and rasterizers take 1.6 mm2", "paper": "1.6 mm2", "verdict": area_verdict(chip),
                "ours": f"{estimate(chip, 1e-6)} mm2, given {GIVEN['power']}; of {by_area['samples']['tried']} samples of the technology "
                f"{by_area['samples']['kept']} have the paper's", "ratio": f"{chip['value'] / 1e6 / PAPER_MM2:.2f}", "bound": "",
                "command": one["command"]})
    share = lane_share(by_area)
    out.append({"claim": "three adders and three multipliers a pair add 7 % to a lane", "paper": "7 %",
                "verdict": HOLDS if share <= LANE_SHARE else NOT,
                "ours": f"{100 * share:.1f} %, given {GIVEN['area']}; {100 * lane_share(one):.1f} % without",
                "ratio": f"{share / LANE_SHARE:.2f}", "bound": "", "command": one["command"]})
    ratio, low, high = (efficiency(by_area, end) for end in ("value", "high", "low"))
    out.append({"claim": "1.7 times GauRast's frames a mm2 and MHz, a rasterizer", "paper": f"{PAPER_EFFICIENCY}x",
                "verdict": HOLDS if low <= PAPER_EFFICIENCY <= high else NOT,
                "ours": f"{ratio:.2g}x ({low:.2g}-{high:.2g}) if a rasterizer has our area given {GIVEN['area']}; {efficiency(one):.2g}x "
                "without; the frames are the paper's, of two scenes", "ratio": f"{ratio / PAPER_EFFICIENCY:.2f}", "bound": "",
                "command": one["command"]})
    return out


def text(data):
    out = [paragraph("""The chip is the paper's: cores and rasterizers, without L2, last-level cache and DRAM. A figure stands with what
        5 and 95 % of 1,000 drawn worlds stay below ([how](../energy.md#uncertainty)). A claim holds if even the 95 % keep to it,
        does not hold if even the 5 % do not, and is open otherwise. *Peak*: the stage with the most power. *Given* the chip's
        published area, power, or both, only worlds remain that agree with it ([how](../energy.md#given-the-chip)): a claim is
        judged given what it is not about."""), ""]
    for machine in machines.PROTOTYPES:
        rows = [row for row in data["rows"] if row["machine"] == machine]
        if not rows:
            continue
        out += [f"## `{machine}`", ""]
        out += table(("scene", "view", "MHz", "V", "frames/s", "chip, mJ", "all, mJ", "chip, W", "given the area", "given area and power",
                      "peak of the chip, W", "given area and power", "in stage"),
                     [(row["scene"], row["view"], row["clock"], f"{row['volts']:.3f}", f"{row['fps']:.1f}",
                       estimate(row["chip_joules"], 1e3), estimate(row["joules"], 1e3), estimate(row["chip_watts"]),
                       estimate(given(row, "area")["chip_watts"]), estimate(given(row, "area_and_power")["chip_watts"]),
                       estimate(row["peak_watts"]), estimate(given(row, "area_and_power")["peak_watts"]), row["peak"]) for row in rows])
    if data["rows"]:
        one = data["rows"][0]
        areas = [of["area"] for of in (one, given(one, "power"), given(one, "area"), given(one, "area_and_power"))]
        out += ["## Area", "", f"Of `{one['machine']}`, at {one['technology']}, in mm2. The paper has {PAPER_MM2}.", ""]
        out += table(("part", "the technology alone", "given the power", "given the area", "given both"),
                     [(parts[0]["part"], *(estimate(part["um2"], 1e-6) for part in parts))
                      for parts in zip(*(area["parts"] for area in areas), strict=True) if parts[0]["part"] not in ("l2", "llc")]
                     + [("all of the chip", *(estimate(area["chip_um2"], 1e-6) for area in areas))])
        both = given(one, "area_and_power")
        out += ["## What gives way", "", paragraph(f"""Of {both['samples']['tried']} samples of the technology {both['samples']['kept']} agree
            with the chip's area and power. Each row's median over these, over its own; those that move most."""), ""]
        out += table(("row", "of", "times"), [(row["row"], row["of"], estimate(row["factor"])) for row in moved(both["rows"])])
    return out


def moved(rows, count=12):
    """Those whose medians a condition moves farthest."""
    return sorted(rows, key=lambda row: -abs(math.log(row["factor"]["value"])))[:count]


def charts(data):
    first = [row for row in data["rows"] if row["machine"] == machines.PROTOTYPES[0] and row["clock"] == CLOCKS[0]]
    if not first:
        return {}
    return {"power": chart("Power of the chip at 530 MHz, prototype", "view", "W", [place(row) for row in first],
                           {"mean of a frame": [row["chip_watts"]["value"] for row in first],
                            "given the chip": [given(row, "area_and_power")["chip_watts"]["value"] for row in first],
                            "its 95 %": [given(row, "area_and_power")["chip_watts"]["high"] for row in first],
                            "peak, given the chip": [given(row, "area_and_power")["peak_watts"]["value"] for row in first],
                            "the paper": [PAPER_WATTS] * len(first)}, bars=True)}
