"""Z-tiling: what parts of a list that are blended apart cost, and what they change."""

import math

import frames
import machines
import runs as r
from runs import Run
from writing import chart, mega, paragraph, table

TITLE = "Z-tiling"
PARTS = (1, 2, 4, 8, 16)
STOPS = (("stop", ()), ("no stop", ("--cutoff", "0")))
PROTOTYPE = machines.PROTOTYPES[0]
MACHINES = (PROTOTYPE, machines.SCALED[PROTOTYPE])


def run(scene, parts, options, machine):
    return Run(scene, scene.views[0], machine, (*r.parted(parts), *options), picture=machine == MACHINES[0])


def wanted(scene):
    """The scaled machine shows what parts gain, for which one stop rule is enough."""
    return [run(scene, k, o, m) for m in MACHINES for _, o in STOPS[:1 if m != MACHINES[0] else None] for k in PARTS]


def rows_of(store, scene):
    rows = []
    for stop, options in STOPS:
        results = {m: dict(zip(PARTS, store.all([run(scene, k, options, m) for k in PARTS])))
                   for m in MACHINES if m == MACHINES[0] or not options}
        whole = frames.floats(store.file(run(scene, 1, options, MACHINES[0]), ".pfm"))
        blends = results[MACHINES[0]][1]["total"]["counters"]["raster_blends"]
        for parts in PARTS:
            result = results[MACHINES[0]][parts]
            largest, mean = difference(store, run(scene, parts, options, MACHINES[0]), whole)
            rows.append({"scene": scene.name, "view": scene.views[0], "stop": stop, "parts": parts, "max_abs": largest,
                         "db": -10 * math.log10(mean) if mean else None,
                         "blends": result["total"]["counters"]["raster_blends"],
                         "blend_ratio": result["total"]["counters"]["raster_blends"] / blends,
                         "cycles": {m: {"blend": r.kernel_cycles(results[m][parts], "rasterize"),
                                        "merge": r.kernel_cycles(results[m][parts], "merge"),
                                        "frame": r.frame_cycles(results[m][parts])} for m in results},
                         "command": result["command"]})
    return rows


def measure(store, all_scenes, _every_view):
    store.prepare([run for scene in all_scenes for run in wanted(scene)])
    return {"machines": MACHINES, "rows": [row for rows in store.rows([(store, scene) for scene in all_scenes], rows_of) for row in rows]}


def difference(store, run, whole):
    return frames.difference(whole, frames.floats(store.file(run, ".pfm")))


def text(data):
    out = [paragraph("""Each list is divided into K parts, which are blended apart and merged by kernels. Errors are against K = 1 with
        the same stop rule. *blends* are relative to K = 1: a part does not know that pixels are full in front of it. Cycles in
        millions: blending / merging / whole frame."""), ""]
    out += table(("scene", "view", "stop rule", "K", "largest difference", "dB", "blends", *MACHINES),
                 [(row["scene"], row["view"], row["stop"], row["parts"],
                   f"{row['max_abs']:.1e}" if row["max_abs"] else "equal",
                   "" if row["db"] is None else f"{row['db']:.1f}", f"{row['blend_ratio']:.3f}x",
                   *(" / ".join(map(mega, row["cycles"][m].values())) if m in row["cycles"] else "" for m in MACHINES))
                  for row in data["rows"]])
    return out


def charts(data):
    series = {}
    for row in data["rows"]:
        if MACHINES[1] in row["cycles"]:
            cycles = row["cycles"][MACHINES[1]]
            series.setdefault(row["scene"], []).append(cycles["blend"] + cycles["merge"])
    return {"z-tiles": chart("Blending and merging with K z-tiles, relative to K = 1, scaled", "K", "throughput",
                             list(map(str, PARTS)), {k: [v[0] / c for c in v] for k, v in series.items()})}
