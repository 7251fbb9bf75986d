"""The pixel unit: throughput by the point at which lists are handed over."""


import machines
import runs as r
from runs import Run
from writing import chart, mega, paragraph, table, terms
from generators import clock

TITLE = "Pixel unit"
MACHINE = machines.PROTOTYPES[0]
RULES = ("last:1/2", "last:1/4", "last:1/8", "last:1/16", "count:256", "occluded:0.5", "occluded:0.9",
         "occluded:0.99")
QUARTER = "last:1/4"
# One with an occluded tail, the private one with the strongest, and one that hardly saturates (its Gaussians are faint).
SCENES = ("indoor-1m", "showroom_indoor", "tower_sh3")
PAPER_GAIN = 0.824
# What a rasterizer does once a tile; the rest is for each entry of its list.
ON_TILES = clock.in_group("rasterizers", "begins or ends a tile")
BUSY = clock.busy("rasterizers")


def spent(units, reasons):
    """Cycles that units' reports have under some reasons."""
    return sum(unit[reason] for unit in units for reason in reasons)


def busy(result):
    """Cycles in which rasterizers did anything."""
    return spent(result["time"]["sum"]["rasterizers"], BUSY)


def on_lists(result):
    """Cycles in which rasterizers went through lists, not cleared or wrote tiles."""
    return busy(result) - spent(result["time"]["sum"]["rasterizers"], ON_TILES)


def measure(store, all_scenes, _every_view):
    chosen = [s for s in all_scenes if s.name in SCENES] or all_scenes[:1]
    places = [(scene, view) for scene in chosen for view in scene.views]

    def runs_of(scene, view):
        return [Run(scene, view, MACHINE, ("--path", "raster")),
                *(Run(scene, view, MACHINE, ("--path", "raster", "--pixel-unit", rule)) for rule in RULES)]

    store.prepare([run for s, v in places for run in runs_of(s, v)])

    def row(scene, view):
        results = store.all(runs_of(scene, view))
        base = results[0]
        points = []
        for rule, result in zip(("off", *RULES), results):
            points.append({"rule": rule, "blend_cycles": r.stage_cycles(result, "blend"),
                           "frame_cycles": r.frame_cycles(result), "rasterizers_busy": busy(result),
                           "on_lists": on_lists(result), "pixel_units_busy": spent(result["time"]["sum"]["pixel_units"], clock.busy("pixel_units")),
                           "tails": result["total"]["counters"]["raster_tails"],
                           "throughput": r.stage_cycles(base, "blend") / r.stage_cycles(result, "blend"),
                           "frame_throughput": r.frame_ms(base) / r.frame_ms(result),
                           "same_picture": result["output_fnv1a64"] == base["output_fnv1a64"],
                           "command": result["command"]})
        quarter = next(p for p in points if p["rule"] == QUARTER)
        share = (points[0]["on_lists"] - quarter["on_lists"]) / points[0]["rasterizers_busy"]
        return {"scene": scene.name, "view": view, "machine": MACHINE, "points": points, "last_quarter_share": share, "bound": 1 / (1 - share)}

    return {"rows": store.rows(places, row)}


def text(data):
    out = [paragraph(f"""Throughput of blending on `{MACHINE}` (one pixel unit for two rasterizers), relative to no hand-over. The
        paper's 82.4 % more needs a last quarter of 45.2 %."""), "",
           *terms([("*last quarter*", """the part of the rasterizers' busy cycles that the last quarter of each list takes: a hand-over there
                    saves it"""),
                   ("*bound*", "1/(1 - last quarter), if the pixel unit and the hand-over cost nothing")])]
    rows = data["rows"]
    out += table(("scene", "view", "no hand-over, Mcycles", *RULES, "last quarter", "bound"),
                 [(row["scene"], row["view"], mega(row["points"][0]["blend_cycles"]),
                   *(f"{p['throughput']:.3f}" for p in row["points"][1:]), f"{100 * row['last_quarter_share']:.1f} %",
                   f"{row['bound']:.3f}") for row in rows])
    out += ["Busy cycles of the pixel unit over those of a rasterizer: above 1 the pixel unit is the longer stage.", ""]
    out += table(("scene", "view", *RULES),
                 [(row["scene"], row["view"],
                   *(f"{2 * p['pixel_units_busy'] / p['rasterizers_busy']:.2f}" for p in row["points"][1:]))
                  for row in rows])
    same = all(p["same_picture"] for row in rows for p in row["points"])
    out += ["All hand-overs give the same bits as none." if same else "**Some hand-over changes the picture.**", ""]
    return out


def charts(data):
    return {"pixel-unit": chart("Blending by hand-over point, relative to none, prototype", "hand-over", "throughput",
                                ("off", *RULES),
                                {f"{row['scene']} {row['view']}": [p["throughput"] for p in row["points"]]
                                 for row in data["rows"]})}
