"""The rasterizer against kernels alone: blending, whole frames, and the bound that blending's share sets."""

import runs as r
from runs import Run
from writing import chart, mega, table

TITLE = "Against kernels alone"
MACHINES = ("prototype", "scaled")
TILES = (8, 16, 32, 64)
GROUPS = (16, 64, 256)
CHOICES = tuple((tile, group) for tile in TILES for group in GROUPS)
# What INRIA's CUDA program uses; tried on every view of the prototype, too.
OFFICIAL = (16, 256)
# Choices this near to the sweep's fastest, in cycles, are tried on every view.
NEAR = 1.05


def simt(scene, view, machine, choice, clock=0):
    return Run(scene, view, machine, ("--path", "simt", "--simt-tile", str(choice[0]), "--simt-group", str(choice[1])),
               clock)


def raster(scene, view, machine):
    return Run(scene, view, machine, ("--path", "raster"))


def sweep(store, scene, view):
    """Cycles of each of the twelve choices on the prototype. One whose instructions alone, one a cycle and core, take longer
    than the fastest so far both in blending and in the frame cannot be the fastest, and is not clocked."""
    counted = dict(zip(CHOICES, store.all([simt(scene, view, "prototype", c, None) for c in CHOICES], "count")))
    rows = {c: {"tile": c[0], "group": c[1], "pairs": result["counts"]["pairs"],
                "blend_instructions": r.stage_instructions(result, "blend"),
                "frame_instructions": result["total"]["counters"]["warp_instructions"],
                "picture_sha256": result["picture_sha256"]} for c, result in counted.items()}
    cores = next(iter(counted.values()))["device"]["compute_units"]
    waiting = sorted(CHOICES, key=lambda c: rows[c]["blend_instructions"])
    while waiting:
        clocked = [row for row in rows.values() if "blend_cycles" in row]
        fastest = {part: min((row[part + "_cycles"] for row in clocked), default=float("inf"))
                   for part in ("blend", "frame")}
        waiting = [c for c in waiting
                   if any(rows[c][part + "_instructions"] / cores < fastest[part] for part in fastest)]
        batch, waiting = waiting[:store.jobs], waiting[store.jobs:]
        for c, result in zip(batch, store.all([simt(scene, view, "prototype", c) for c in batch], "sweep")):
            rows[c].update(blend_cycles=r.stage_cycles(result, "blend"), frame_cycles=r.frame_cycles(result))
    return {"scene": scene.name, "view": view, "cores": cores, "rows": list(rows.values())}


def candidates(swept):
    """Choices within NEAR of the fastest blending or the fastest frame of a sweep."""
    rows = [row for row in swept["rows"] if "blend_cycles" in row]
    return [(row["tile"], row["group"]) for row in rows
            if any(row[part] <= NEAR * min(other[part] for other in rows) for part in ("blend_cycles", "frame_cycles"))]


def compared(with_it, without):
    """A row of the table: the raster path's result and the kernels' by choice."""
    blends = with_it["total"]["counters"]["raster_blends"]
    cores = with_it["device"]["compute_units"]

    def kernels(result, choice):
        blend = r.stage_cycles(result, "blend")
        instructions = r.stage_instructions(result, "blend")
        return {"tile": choice[0], "group": choice[1], "blend_cycles": blend, "frame_cycles": r.frame_cycles(result),
                "frame_ms": r.frame_ms(result), "ipc": instructions / (blend * cores),
                "instructions_a_blend": instructions / blends, "command": result["command"]}

    tried = [kernels(result, choice) for choice, result in without.items()]
    fastest_blend = min(tried, key=lambda row: row["blend_cycles"])
    fastest_frame = min(tried, key=lambda row: row["frame_ms"])
    blend, ms = r.stage_cycles(with_it, "blend"), r.frame_ms(with_it)
    share = fastest_frame["blend_cycles"] / fastest_frame["frame_cycles"]
    rest = ms * (1 - blend / r.frame_cycles(with_it))
    official = next((row for row in tried if (row["tile"], row["group"]) == OFFICIAL), None)
    return {"blends": blends, "official_frame": official, "blend_cycles": blend, "frame_cycles": r.frame_cycles(with_it), "frame_ms": ms,
            "fps": with_it["time"]["fps"], "clock_mhz": with_it["time"]["sum"]["clock_mhz"],
            "kernels_blend": fastest_blend, "kernels_frame": fastest_frame,
            "blend_speedup": fastest_blend["blend_cycles"] / blend, "frame_speedup": fastest_frame["frame_ms"] / ms,
            "blend_share": share, "bound": 1 / (1 - share), "bound_rest": fastest_frame["frame_ms"] / rest,
            "command": with_it["command"]}


def measure(store, all_scenes, every_view):
    """every_view: sweep all views, not one of each scene."""
    sweeps, rows = [], []
    for scene in all_scenes:
        own = [sweep(store, scene, view) for view in (scene.views if every_view else scene.views[:1])]
        sweeps += own
        best = {c for s in own for c in candidates(s)}
        choices = {machine: sorted({OFFICIAL, *best} if machine == MACHINES[0] else best) for machine in MACHINES}
        wanted = [(machine, view) for machine in MACHINES for view in scene.views]
        store.all([run for m, v in wanted for run in (raster(scene, v, m), *(simt(scene, v, m, c) for c in choices[m]))],
                  TITLE)
        for machine, view in wanted:
            with_it, = store.all([raster(scene, view, machine)], TITLE)
            without = store.all([simt(scene, view, machine, c) for c in choices[machine]], TITLE)
            rows.append({"scene": scene.name, "view": view, "machine": machine,
                         **compared(with_it, dict(zip(choices[machine], without)))})
    return {"sweeps": sweeps, "rows": rows}


def text(data):
    out = ["The same frame with the rasterizer (tiles of 64) and with kernels alone, whose lists are staged in local memory and which end a "
           "tile when its pixels are full. Both are timed by the same clock. The kernels' choice of tile and group is the fastest in cycles; "
           "one choice may be fastest at blending and another in the whole frame. *share*: blending's part of the fastest kernels-only frame; "
           "*bound*: what no rasterizer can exceed if all else stays as it is in that frame, 1/(1 - share). All else does not quite stay, since larger tiles make "
           "shorter lists: *rest* is the kernels-only frame over our frame without any blending, what a rasterizer of no time at all would give here.", ""]
    for machine in MACHINES:
        rows = [row for row in data["rows"] if row["machine"] == machine]
        if not rows:
            continue
        out += [f"### `{machine}`, {rows[0]['clock_mhz']} MHz", ""]
        out += table(("scene", "view", "frame, Mcycles", "frames/s", "blend, Mcycles", "kernels: frame", "kernels: blend",
                      "tile/group", "IPC a core", "instructions a blend", "share", "bound", "rest", "blending", "whole frame"),
                     [(row["scene"], row["view"], mega(row["frame_cycles"]), f"{row['fps']:.1f}", mega(row["blend_cycles"]),
                       mega(row["kernels_frame"]["frame_cycles"]), mega(row["kernels_blend"]["blend_cycles"]),
                       choices_text(row), f"{row['kernels_blend']['ipc']:.2f}",
                       f"{row['kernels_blend']['instructions_a_blend']:.1f}", f"{100 * row['blend_share']:.1f} %",
                       f"{row['bound']:.2f}x", f"{row['bound_rest']:.2f}x", f"{row['blend_speedup']:.1f}x",
                       f"{row['frame_speedup']:.2f}x") for row in rows])
    out += ["### The choice of tile and group", "",
            "Mcycles of blending / of the frame on the prototype; a dash: its instructions alone, one a cycle and core, take longer than the "
            "fastest, so it was not clocked.", ""]
    out += table(("scene", "view", *(f"{tile}/{group}" for tile, group in CHOICES)),
                 [(s["scene"], s["view"],
                   *(f"{mega(row['blend_cycles'])} / {mega(row['frame_cycles'])}" if "blend_cycles" in row else "-"
                     for row in s["rows"])) for s in data["sweeps"]])
    return out


def choices_text(row):
    blend, frame = ((row[k]["tile"], row[k]["group"]) for k in ("kernels_blend", "kernels_frame"))
    shown = f"{blend[0]}/{blend[1]}"
    return shown if blend == frame else f"{shown}, frame {frame[0]}/{frame[1]}"


def charts(data):
    rows = [row for row in data["rows"] if row["machine"] == "prototype"]
    return {"speedup": chart("Speed-up over kernels alone, prototype", "scene and view", "times",
                             [f"{row['scene'].split('_')[0]} {row['view']}" for row in rows],
                             {"blending": [row["blend_speedup"] for row in rows],
                              "whole frame": [row["frame_speedup"] for row in rows],
                              "bound of the frame": [row["bound"] for row in rows]}, bars=True)}
