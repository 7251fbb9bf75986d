"""The rasterizer against kernels alone: blending, whole frames, and the bound that blending's share sets."""

import runs as r
from choices import candidates, simt
from runs import Run
from writing import chart, mega, paragraph, table

TITLE = "Against kernels alone"
MACHINES = ("prototype", "scaled")
# What INRIA's CUDA program uses; tried on every view of the prototype, too.
OFFICIAL = (16, 256)


def raster(scene, view, machine):
    return Run(scene, view, machine, ("--path", "raster"))


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
    counters = with_it["total"]["counters"]
    pixels = with_it["resolution"][0] * with_it["resolution"][1] / counters["raster_commands"]
    return {"blends": blends, "lane_use": blends / counters["raster_fragments"],
            "lane_use_unclipped": blends / (counters["raster_gaussians"] * pixels), "official_frame": official, "blend_cycles": blend,
            "frame_cycles": r.frame_cycles(with_it), "frame_ms": ms,
            "fps": with_it["time"]["fps"], "clock_mhz": with_it["time"]["sum"]["clock_mhz"],
            "kernels_blend": fastest_blend, "kernels_frame": fastest_frame,
            "blend_speedup": fastest_blend["blend_cycles"] / blend, "frame_speedup": fastest_frame["frame_ms"] / ms,
            "blend_share": share, "bound": 1 / (1 - share), "bound_rest": fastest_frame["frame_ms"] / rest,
            "command": with_it["command"]}


def measure(store, all_scenes, _every_view):
    """The choices are those that choices.py found."""
    swept = store.read("choices")
    if not swept:
        raise r.Failed("no choice of tile and group, expected section choices to have been measured")
    best = {c for s in swept["sweeps"] for c in candidates(s)}
    choices = {machine: sorted({OFFICIAL, *best} if machine == MACHINES[0] else best) for machine in MACHINES}
    places = [(scene, view, machine) for scene in all_scenes for machine in MACHINES for view in scene.views]
    store.prepare([run for s, v, m in places for run in (raster(s, v, m), *(simt(s, v, m, c) for c in choices[m]))], TITLE)

    def row(scene, view, machine):
        with_it, *without = store.all([raster(scene, view, machine),
                                       *(simt(scene, view, machine, c) for c in choices[machine])], TITLE)
        return {"scene": scene.name, "view": view, "machine": machine,
                **compared(with_it, dict(zip(choices[machine], without)))}

    return {"rows": store.rows(places, row)}


def text(data):
    out = [paragraph("""The same frame with the rasterizer (tiles of 64) and with kernels alone, whose lists are staged in local
        memory and which end a tile when its pixels are full. Both are timed by the same clock. The kernels' choice of tile and
        group is the fastest in cycles; one choice may be fastest at blending and another in the whole frame: those that are so
        for some scene in the section before are tried on every view, and the fastest of them is taken. *share*: blending's part of the fastest
        kernels-only frame; *bound*: what no rasterizer can exceed if all else stays as it is in that frame, 1/(1 - share). All
        else does not quite stay, since larger tiles make shorter lists: *rest* is the kernels-only frame over our frame without
        any blending, what a rasterizer of no time at all would give here. *lanes*: the part of the rasterizers' lane slots that
        blend, and what it would be if a Gaussian's box were not cut to the tile but all its pixels tried."""), ""]
    for machine in MACHINES:
        rows = [row for row in data["rows"] if row["machine"] == machine]
        if not rows:
            continue
        out += [f"### `{machine}`, {rows[0]['clock_mhz']} MHz", ""]
        out += table(("scene", "view", "frame, Mcycles", "frames/s", "blend, Mcycles", "kernels: frame",
                      "kernels: blend", "tile/group", "IPC a core", "instructions a blend", "share", "bound", "rest",
                      "blending", "whole frame", "lanes"),
                     [(row["scene"], row["view"], mega(row["frame_cycles"]), f"{row['fps']:.1f}", mega(row["blend_cycles"]),
                       mega(row["kernels_frame"]["frame_cycles"]), mega(row["kernels_blend"]["blend_cycles"]),
                       choices_text(row), f"{row['kernels_blend']['ipc']:.2f}",
                       f"{row['kernels_blend']['instructions_a_blend']:.1f}", f"{100 * row['blend_share']:.1f} %",
                       f"{row['bound']:.2f}x", f"{row['bound_rest']:.2f}x", f"{row['blend_speedup']:.1f}x",
                       f"{row['frame_speedup']:.2f}x",
                       f"{100 * row['lane_use']:.0f} %, {100 * row['lane_use_unclipped']:.1f} %") for row in rows])
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
