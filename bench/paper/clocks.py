"""How a frame's time splits into a part that scales with the clock and one that does not."""

import machines
import runs as r
from runs import Run
from writing import chart, paragraph, table, terms

TITLE = "Two parts of a frame's time"
CLOCKS = (100, 230, 530)
# What fits the paper's 6.4 and 19 frames a second at 100 and 530 MHz.
PAPER_MCYCLES, PAPER_MS = 12.8, 28.5


def fit(clocks, milliseconds):
    """Least squares of t = a/f + b: Mcycles, ms, and the largest difference in ms."""
    x = [1e3 / clock for clock in clocks]
    n, mean_x, mean_t = len(x), sum(x) / len(x), sum(milliseconds) / len(x)
    if n < 2:
        raise ValueError("a fit needs two clocks")
    a = sum((u - mean_x) * (t - mean_t) for u, t in zip(x, milliseconds)) / sum((u - mean_x) ** 2 for u in x)
    b = mean_t - a * mean_x
    return a, b, max(abs(a * u + b - t) for u, t in zip(x, milliseconds))


def run_at(scene, view, machine, clock):
    """The prototype's own clock is the last one, for which other sections have the run."""
    return Run(scene, view, machine, ("--path", "raster"), 0 if clock == CLOCKS[-1] else clock)


def measure(store, all_scenes, _every_view):
    places = [(scene, view, m) for m in machines.PROTOTYPES for scene in all_scenes for view in scene.views]
    store.prepare([run_at(s, v, m, c) for s, v, m in places for c in CLOCKS])

    def row(scene, view, machine):
        results = store.all([run_at(scene, view, machine, c) for c in CLOCKS])
        times = [r.frame_ms(result) for result in results]
        a, b, off = fit(CLOCKS, times)
        return {"scene": scene.name, "view": view, "machine": machine, "gaussians": r.gaussians(results[-1]), "clocks_mhz": CLOCKS, "frame_ms": times,
                "fps": [result["time"]["fps"] for result in results], "mcycles": a, "ms": b, "largest_ms_off": off,
                "command": results[-1]["command"], "slow_command": results[0]["command"]}

    return {"rows": store.rows(places, row)}


def text(data):
    fixed = f"{100 * PAPER_MS / (PAPER_MS + PAPER_MCYCLES * 1e3 / CLOCKS[-1]):.0f} %"
    out = [paragraph(f"""The time of a frame as t = a/f + b, by least squares over f = {', '.join(map(str, CLOCKS))} MHz; raster path,
        serial. The paper's end points give {PAPER_MCYCLES} Mcycles and {PAPER_MS} ms."""), "",
           *terms([("*off*", "the largest difference of a time from the line"),
                   ("*fixed*", f"b's part of the frame at {CLOCKS[-1]} MHz")])]
    first, last = CLOCKS[0], CLOCKS[-1]
    for machine in machines.PROTOTYPES:
        rows = [row for row in data["rows"] if row["machine"] == machine]
        if not rows:
            continue
        out += [f"## `{machine}`", ""]
        out += table(("scene", "view", f"frames/s at {first}", f"at {last}", "ratio", "a, Mcycles", "b, ms", "off, ms", "fixed"),
                     [(row["scene"], row["view"], f"{row['fps'][0]:.1f}", f"{row['fps'][-1]:.1f}",
                       f"{row['fps'][-1] / row['fps'][0]:.2f}x", f"{row['mcycles']:.2f}", f"{row['ms']:.2f}",
                       f"{row['largest_ms_off']:.2f}", f"{100 * row['ms'] / row['frame_ms'][-1]:.0f} %")
                      for row in rows]
                     + [("paper", "", "6.4", "19", f"{19 / 6.4:.2f}x", f"{PAPER_MCYCLES}", f"{PAPER_MS}", "", fixed)])
    return out


def charts(data):
    paper = [1e3 / (PAPER_MCYCLES * 1e3 / clock + PAPER_MS) for clock in CLOCKS]
    first = {}
    for row in data["rows"]:
        if row["machine"] == machines.PROTOTYPES[0]:
            first.setdefault(row["scene"], row)
    return {"clocks": chart("Frames a second by clock, prototype", "MHz", "frames/s", list(map(str, CLOCKS)),
                            {**{f"{name} {row['view']}": row["fps"] for name, row in first.items()},
                             "the paper's line": paper})}
