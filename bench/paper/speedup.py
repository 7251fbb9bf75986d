"""The rasterizer against kernels alone: blending, whole frames, and the bound that blending's share sets."""

import machines
import runs as r
from choices import candidates, simt
from runs import Run
from writing import chart, mega, table, terms

TITLE = "Against kernels alone"
# As INRIA's program does it: its tiles, a work-item a pixel, its reach, and no test that spares a pixel the exponential.
OFFICIAL = ("--path", "simt", "--support", "official16", "--tile", "16", "--simt-group", "256")
BASELINES = {"fastest": "our fastest kernels", "official": "the official algorithm, step by step"}


def raster(scene, view, machine):
    return Run(scene, view, machine, ("--path", "raster"))


def official(scene, view, machine):
    return Run(scene, view, machine, OFFICIAL)


def _against(kernels, with_it):
    """A kernels-only frame beside the raster path's of the same machine."""
    blend, frame = r.stage_cycles(kernels, "blend"), r.frame_cycles(kernels)
    share = blend / frame
    return {"blend_cycles": blend, "frame_cycles": frame, "blend_share": share, "bound": 1 / (1 - share),
            "ipc": r.stage_instructions(kernels, "blend") / (blend * kernels["device"]["compute_units"]),
            "serial": r.frame_ms(kernels) / r.frame_ms(with_it), "overlapped": r.frame_ms(kernels) / r.overlapped_ms(with_it),
            "blending": blend / r.stage_cycles(with_it, "blend"), "command": kernels["command"]}


def compared(with_it, without, step_by_step):
    """A row of the table: the raster path's result, the kernels' by choice, and the official algorithm's or None."""
    counters = with_it["total"]["counters"]
    blends = counters["raster_blends"]
    choice, fastest = min(without.items(), key=lambda item: r.frame_ms(item[1]))
    pixels = with_it["resolution"][0] * with_it["resolution"][1] / counters["raster_commands"]
    rest = r.frame_ms(with_it) * (1 - r.stage_cycles(with_it, "blend") / r.frame_cycles(with_it))
    return {"blends": blends, "lane_use": blends / counters["raster_fragments"],
            "lane_use_unclipped": blends / (counters["raster_gaussians"] * pixels),
            "frame_cycles": r.frame_cycles(with_it), "blend_cycles": r.stage_cycles(with_it, "blend"),
            "clock_mhz": with_it["time"]["sum"]["clock_mhz"], "tile": choice[0], "group": choice[1],
            "fastest": _against(fastest, with_it), "bound_rest": r.frame_ms(fastest) / rest,
            "official": _against(step_by_step, with_it) if step_by_step else None, "command": with_it["command"]}


def measure(store, all_scenes, _every_view):
    """The choices are those that choices.py found."""
    swept = store.read("choices")
    if not swept:
        raise r.Failed("no choice of tile and group, expected section choices to have been measured")
    best = sorted({c for s in swept["sweeps"] for c in candidates(s)})
    places = [(scene, view, m) for m in machines.PROTOTYPES for scene in all_scenes for view in scene.views]
    store.prepare([run for s, v, m in places
                   for run in (raster(s, v, m), *(simt(s, v, m, c) for c in best), official(s, v, m))])

    def row(scene, view, machine):
        with_it, = store.all([raster(scene, view, machine)])
        without = store.those_there({c: simt(scene, view, machine, c) for c in best})
        if not without:
            raise r.Missing(f"{scene.name}-{view}-{machine}-path-simt")
        step_by_step = store.those_there({"official": official(scene, view, machine)})
        return {"scene": scene.name, "view": view, "machine": machine,
                **compared(with_it, without, step_by_step.get("official"))}

    return {"rows": store.rows(places, row), "choices": best}


def text(data):
    tried = ", ".join(f"{tile}/{group}" for tile, group in data["choices"])
    out = ["The same frame with the rasterizer (tiles of 64) and with kernels alone, on the same machine.", "",
           *terms([("*fastest*", f"""our kernels, whose lists are staged in local memory and which end a tile when its pixels are full.
                    Tile and group are the fastest of those that won a sweep ([choices](choices.md)): {tried}"""),
                   ("*official*", """blending as INRIA's program does it: 16x16 tiles, a work-item a pixel, its square of three deviations
                    as reach, the exponential for every pixel of the tile and every Gaussian of its list. Projecting and sorting stay
                    ours"""),
                   ("*share*", "blending's part of the kernels-only frame"),
                   ("*bound*", "1/(1 - share): the most that a rasterizer can give if the rest of that frame stays as it is"),
                   ("*rest*", """the kernels-only frame over ours without blending. It may exceed the bound, because larger tiles make
                    shorter lists and so change the rest of the frame"""),
                   ("*serial*, *overlapped*", "whole frames over ours. The kernels-only frame has nothing to overlap"),
                   ("*lanes*", """the part of the rasterizers' lane slots that blend, and what it would be if a Gaussian's box were not
                    cut to the tile""")])]
    for machine in machines.PROTOTYPES:
        rows = [row for row in data["rows"] if row["machine"] == machine]
        if not rows:
            continue
        out += [f"## `{machine}`, {rows[0]['clock_mhz']} MHz", ""]
        lines = []
        for row in rows:
            for baseline in BASELINES:
                if k := row[baseline]:
                    ours = baseline == "fastest"
                    lines.append((row["scene"], row["view"], f"{baseline} {row['tile']}/{row['group']}" if ours else baseline,
                                  mega(row["frame_cycles"]), mega(row["blend_cycles"]), mega(k["frame_cycles"]),
                                  mega(k["blend_cycles"]), f"{k['ipc']:.2f}", f"{100 * k['blend_share']:.1f} %",
                                  f"{k['bound']:.1f}x", f"{row['bound_rest']:.1f}x" if ours else "",
                                  f"{k['blending']:.1f}x", f"{k['serial']:.2f}x", f"{k['overlapped']:.2f}x",
                                  f"{100 * row['lane_use']:.0f} %, {100 * row['lane_use_unclipped']:.1f} %" if ours else ""))
        out += table(("scene", "view", "baseline", "frame, Mcycles", "blend, Mcycles", "kernels: frame", "kernels: blend",
                      "IPC a core", "share", "bound", "rest", "blending", "serial", "overlapped", "lanes"), lines)
    return out


def charts(data):
    rows = [row for row in data["rows"] if row["machine"] == machines.PROTOTYPES[0]]
    return {"speedup": chart("Times faster than our fastest kernels, prototype", "scene and view", "times",
                             [f"{row['scene']} {row['view']}" for row in rows],
                             {"blending": [row["fastest"]["blending"] for row in rows],
                              "frame, serial": [row["fastest"]["serial"] for row in rows],
                              "frame, overlapped": [row["fastest"]["overlapped"] for row in rows],
                              "bound of the frame": [row["fastest"]["bound"] for row in rows]}, bars=True)} if rows else {}
