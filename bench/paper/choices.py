"""Which tile and group make the kernels that blend without the rasterizer fastest."""

import machines
import runs as r
from runs import Run
from writing import mega, paragraph, table

TITLE = "The kernels' choice of tile and group"
MACHINE = machines.PROTOTYPES[0]
TILES = (8, 16, 32, 64)
GROUPS = (16, 64, 256)
CHOICES = tuple((tile, group) for tile in TILES for group in GROUPS)


def simt(scene, view, machine, choice, clock=0):
    return Run(scene, view, machine, ("--path", "simt", "--tile", str(choice[0]), "--simt-group", str(choice[1])),
               clock)


def sweep(store, scene, view):
    """Cycles of each of the twelve choices on MACHINE. One is not clocked if its blending, at as many instructions as a core
    can fetch, would take longer than the fastest blending so far, and with the shortest rest of a frame so far longer than
    the fastest frame."""
    counted = dict(zip(CHOICES, store.all([simt(scene, view, MACHINE, c, None) for c in CHOICES])))
    rows = {c: {"tile": c[0], "group": c[1], "pairs": result["counts"]["pairs"],
                "blend_instructions": r.stage_instructions(result, "blend"),
                "output_fnv1a64": result["output_fnv1a64"]} for c, result in counted.items()}
    cores = next(iter(counted.values()))["device"]["compute_units"]
    least = {c: rows[c]["blend_instructions"] / cores * machines.fetch_interval(MACHINE) for c in CHOICES}
    waiting = sorted(CHOICES, key=lambda c: rows[c]["blend_instructions"])
    while waiting:
        clocked = [row for row in rows.values() if "blend_cycles" in row]
        blend, frame = (min((row[part] for row in clocked), default=float("inf")) for part in ("blend_cycles", "frame_cycles"))
        rest = min((row["frame_cycles"] - row["blend_cycles"] for row in clocked), default=0)
        waiting = [c for c in waiting if least[c] < max(blend, frame - rest)]
        batch, waiting = waiting[:store.jobs], waiting[store.jobs:]
        for c, result in zip(batch, store.all([simt(scene, view, MACHINE, c) for c in batch])):
            rows[c].update(blend_cycles=r.stage_cycles(result, "blend"), frame_cycles=r.frame_cycles(result))
    return {"scene": scene.name, "view": view, "cores": cores, "rows": list(rows.values())}


def candidates(swept):
    """The choices of the fastest blending and of the fastest frame of a sweep."""
    rows = [row for row in swept["rows"] if "blend_cycles" in row]
    return sorted({(best["tile"], best["group"]) for best in (min(rows, key=lambda row, p=part: row[p + "_cycles"])
                                                              for part in ("blend", "frame"))})


def measure(store, all_scenes, every_view):
    """every_view: of all views, not of two of each scene."""
    return {"sweeps": store.rows([(store, scene, view) for scene in all_scenes
                                  for view in (scene.views if every_view else scene.views[:2])], sweep)}


def text(data):
    out = [paragraph(f"""Mcycles of blending / of the frame on `{MACHINE}`. A dash is a choice that was not clocked, because it cannot
        be the fastest: a core needs longer to fetch its instructions than the fastest blending takes, and with the shortest rest of
        any frame longer than the fastest frame takes."""), ""]
    return out + table(("scene", "view", *(f"{tile}/{group}" for tile, group in CHOICES)),
                       [(s["scene"], s["view"],
                         *(f"{mega(row['blend_cycles'])} / {mega(row['frame_cycles'])}" if "blend_cycles" in row else "-"
                           for row in s["rows"])) for s in data["sweeps"]])


def charts(_data):
    return {}
