"""Power, area and efficiency of the chip, estimated (docs/energy.md)."""

import machines
from runs import Run
from verdicts import HOLDS, NOT, place
from writing import chart, paragraph, table

TITLE = "Power and area"
# The paper's clocks; which voltages belong to them is ours (docs/energy.md).
CLOCKS = (530, 100)
PAPER_WATTS, PAPER_MM2 = 0.6, 1.6
OPEN = "open"


def run(scene, view, machine, clock):
    """With an exponential that a chip would have."""
    return Run(scene, view, machine, ("--exp", "table", "--energy"), 0 if clock == CLOCKS[0] else clock)


def measure(store, all_scenes, _every_view):
    places = [(scene, view, m, f"{clock} MHz") for m in machines.PROTOTYPES for clock in CLOCKS for scene in all_scenes
              for view in scene.views]
    store.prepare([run(scene, view, m, clock) for m in machines.PROTOTYPES for clock in CLOCKS for scene in all_scenes
                   for view in scene.views])

    def row(scene, view, machine, at):
        clock = int(at.split()[0])
        result, = store.all([run(scene, view, machine, clock)])
        spent = result["energy"]
        peak = max(spent["stages"], key=lambda stage: stage["chip_watts"]["value"])
        return {"scene": scene.name, "view": view, "machine": machine, "clock": clock, "volts": spent["volts"],
                "technology": spent["technology"], "fps": result["time"]["fps"], "chip_joules": spent["chip_joules"],
                "joules": spent["joules"], "chip_watts": spent["chip_watts"], "peak": peak["name"], "peak_watts": peak["chip_watts"],
                "area": spent["area"], "command": result["command"]}

    return {"rows": store.rows(places, row)}


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


def power_claim(what, rows, key):
    found = [row[key] for row in rows]
    low, high = (pick(rows, key=lambda row: row[key]["value"]) for pick in (min, max))
    return {"claim": what, "paper": "< 600 mW", "verdict": counted([against(f, PAPER_WATTS) for f in found]),
            "ours": f"{low[key]['value']:.2g} W ({place(low)}, `{low['machine']}`) to {high[key]['value']:.2g} W ({place(high)}, "
            f"`{high['machine']}`), intervals from {min(f['low'] for f in found):.2g} to {max(f['high'] for f in found):.2g}",
            "ratio": f"{low[key]['value'] / PAPER_WATTS:.2f} to {high[key]['value'] / PAPER_WATTS:.2f}", "bound": "",
            "command": high["command"]}


def claims_of(data):
    fast, slow = ([row for row in data["rows"] if row["clock"] == clock] for clock in CLOCKS)
    out = []
    if fast:
        out += [power_claim(f"under 600 mW at {CLOCKS[0]} MHz, mean of a frame", fast, "chip_watts"),
                power_claim("the same, of the stage with the most power", fast, "peak_watts")]
    if slow:
        out.append(power_claim(f"under 600 mW at {CLOCKS[1]} MHz, mean of a frame", slow, "chip_watts"))
    one = (fast or slow)[0]
    chip = one["area"]["chip_um2"]
    out.append({"claim": "cores and rasterizers take 1.6 mm2", "paper": "1.6 mm2", "verdict": area_verdict(chip),
                "ours": f"{estimate(chip, 1e-6)} mm2", "ratio": f"{chip['value'] / 1e6 / PAPER_MM2:.2f}", "bound": "",
                "command": one["command"]})
    return out


def text(data):
    out = [paragraph("""The chip is the paper's: cores and rasterizers, without L2, last-level cache and DRAM. A figure stands with what
        5 and 95 % of 1,000 drawn worlds stay below ([how](../energy.md#uncertainty)). A claim holds if even the 95 % keep to it,
        does not hold if even the 5 % do not, and is open otherwise. *Peak*: the stage with the most power."""), ""]
    for machine in machines.PROTOTYPES:
        rows = [row for row in data["rows"] if row["machine"] == machine]
        if not rows:
            continue
        out += [f"## `{machine}`", ""]
        out += table(("scene", "view", "MHz", "V", "frames/s", "chip, mJ", "all, mJ", "chip, W", "peak of the chip, W", "in stage"),
                     [(row["scene"], row["view"], row["clock"], f"{row['volts']:.3f}", f"{row['fps']:.1f}",
                       estimate(row["chip_joules"], 1e3), estimate(row["joules"], 1e3), estimate(row["chip_watts"]),
                       estimate(row["peak_watts"]), row["peak"]) for row in rows])
    if data["rows"]:
        area = data["rows"][0]["area"]
        out += ["## Area", "", f"Of `{data['rows'][0]['machine']}`, at {data['rows'][0]['technology']}. The paper has {PAPER_MM2} mm2.", ""]
        out += table(("part", "mm2"), [(part["part"], estimate(part["um2"], 1e-6)) for part in area["parts"]
                                         if part["part"] not in ("l2", "llc")]
                     + [("all of the chip", estimate(area["chip_um2"], 1e-6))])
    return out


def charts(data):
    first = [row for row in data["rows"] if row["machine"] == machines.PROTOTYPES[0] and row["clock"] == CLOCKS[0]]
    if not first:
        return {}
    return {"power": chart("Power of the chip at 530 MHz, prototype", "view", "W", [place(row) for row in first],
                           {"mean of a frame": [row["chip_watts"]["value"] for row in first],
                            "its 95 %": [row["chip_watts"]["high"] for row in first],
                            "the paper": [PAPER_WATTS] * len(first)}, bars=True)}
