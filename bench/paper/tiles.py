"""Gaussian invocations by tile size, and how soon pixels are full: counts of the scenes, without a machine."""

import invocations
from runs import Missing
from writing import chart, paragraph, table

TITLE = "Tiles and occlusion"
OCCLUDED_WIDTH = 960
TILE = "64"
# What the paper calls occluded: more than 90 % of the pixels.
MOST = 0.9


def reached(curve):
    """The percent of the lists at which MOST of the pixels are full, or None."""
    return next((percent for percent, share in enumerate(curve) if share >= MOST), None)


def measure(store, all_scenes, _every_view, widths=invocations.WIDTHS):
    rows = []
    for scene in all_scenes:
        for view in scene.views:
            row = {"scene": scene.name, "view": view, "fewer": {s: {} for s in invocations.SUPPORTS}}
            for width in widths:
                try:
                    found = store.measured([invocations.point(scene, view, width)])[0]["report"]
                except Missing:
                    continue
                for support in invocations.SUPPORTS:
                    pairs = found["invocations_by_support"][support]
                    row["fewer"][support][str(width)] = 1 - pairs["64"] / pairs["16"] if pairs["16"] else None
                if width == OCCLUDED_WIDTH or width == widths[0]:
                    curve = found["lists"][TILE]["occluded_by_percent"]
                    row.update(occluded=curve, occluded_from=reached(curve))
            if "occluded" in row:
                rows.append(row)
            else:
                store.left_out.append(f"{scene.name} {view}")
    return {"rows": rows, "widths": list(widths)}


def shown(share):
    return "none" if share is None else "-" if share == "" else f"{100 * share:.1f}"


def text(data):
    columns = [(s, str(w)) for s in invocations.SUPPORTS for w in data["widths"]]
    out = [paragraph("""How many (Gaussian, tile) pairs tiles of 64 pixels save over tiles of 16, in percent, by support and picture
        width (a dash: not counted yet)."""), ""]
    out += table(("scene", "view", *(f"{s} {w}" for s, w in columns)),
                 [(row["scene"], row["view"], *(shown(row["fewer"][s].get(w, "")) for s, w in columns))
                  for row in data["rows"]])
    out += [paragraph("""Pixels that are full (nothing more is blended) when so much of their tile's list is done, in percent; tiles of
        64, support `square3`. *from* is the part of the list after which 90 % of all pixels are full."""), ""]
    out += table(("scene", "view", "25 %", "50 %", "75 %", "all", "from"),
                 [(row["scene"], row["view"], *(f"{100 * row['occluded'][p]:.1f}" for p in (25, 50, 75, 100)),
                   "never" if row["occluded_from"] is None else f"{row['occluded_from']} %") for row in data["rows"]])
    return out


def charts(data):
    first = {}
    for row in data["rows"]:
        first.setdefault(row["scene"], row)
    top = sorted(first.values(), key=lambda row: -row["occluded"][100])[:7]
    percents = range(0, 101, 5)
    return {"occlusion": chart("Full pixels by depth in the tile's list", "percent of the list", "percent of the pixels",
                               list(map(str, percents)),
                               {f"{row['scene']} {row['view']}": [100 * row["occluded"][p] for p in percents]
                                for row in top})}
