#!/usr/bin/env python3
"""What each idea for the rasterizer is worth on a view: cycles, energy and area beside the machine without it (docs/ideas.md).

usage: ideas.py SCENE --cameras FILE --view NAME [--config MACHINE]

Prints a Markdown table. Every idea draws the same bits as the picture of its tile size, or the program ends with an error.
"""

import argparse
import sys

import clocked
import command_line
import study
import timed_frame
from generators import clock

BUSY = clock.busy("rasterizers")  # reasons for which a rasterizer is not idle

# What the table calls it, settings of the machine, options of splat render.
IDEAS = [
    ("none", "", ()),
    ("tiles of 32 pixels", "", ("--tile", "32")),
    ("the same, halves of the pixel buffer", "timing.raster.tile_overlap=1", ("--tile", "32")),
    ("a second pixel buffer", "timing.raster.tile_overlap=2", ()),
    ("32 banks for 16 lanes", "timing.raster.banks=32", ()),
    ("blocks outside of the ellipse skipped", "timing.raster.skip_blocks=1", ()),
    ("closed blocks skipped", "timing.raster.skip_blocks=2", ()),
    ("both kinds of block", "timing.raster.skip_blocks=3", ()),
    ("64 places for Gaussians", "timing.raster.buffer_entries=64", ()),
    ("128 places for Gaussians", "timing.raster.buffer_entries=128", ()),
    ("64 places, both kinds of block", "timing.raster.buffer_entries=64,timing.raster.skip_blocks=3", ()),
    ("closed pixels skipped", "", ("--skip-saturated",)),
    ("second buffer, both kinds of block", "timing.raster.tile_overlap=2,timing.raster.skip_blocks=3", ()),
]


def point(args, name, settings, options):
    variables = {"VORION_CONFIG": args.config} if args.config else {}
    if settings:
        variables["VORION_SET"] = settings
    return study.render(name, timed_frame.scene_of(args), args.view, "--exp", "table", "--energy", *options, **variables)


def figures(found):
    busy = sum(one[reason] for one in found["time"]["sum"]["rasterizers"] for reason in BUSY)
    blend = next(stage["time"]["cycles"] for stage in found["time"]["stages"] if stage["name"] == "blend")
    return {"machine": clocked.name(found["time"]["sum"]), "picture": found["result_fnv1a64"], "busy": busy, "blend": blend, "cycles": found["time"]["sum"]["cycles"],
            "joules": found["energy"]["chip_joules"]["value"], "um2": found["energy"]["area"]["chip_um2"]["value"]}


def change(value, base):
    return f"{100 * (value / base - 1):+.1f} %"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    timed_frame.add_view(parser)
    parser.add_argument("--config", help="a machine, by its name or its file")
    args = parser.parse_args()
    print("| idea | rasterizers, Mcycles | blending, Mcycles | frame, Mcycles | chip, mJ | chip, mm2 |\n|---|--:|--:|--:|--:|--:|")
    pictures, base, names = {}, None, []
    for (name, _, options), found in zip(IDEAS, study.reports([point(args, *idea) for idea in IDEAS]), strict=True):
        one = figures(found)
        tile = options[options.index("--tile") + 1] if "--tile" in options else "64"
        if pictures.setdefault(tile, one["picture"]) != one["picture"]:
            sys.exit(f"ideas.py: error: {name}: another picture, expected the same bits")
        base = base or one
        cells = [(f"{one[key] / scale:.{digits}f}" if one is base else change(one[key], base[key]))
                 for key, scale, digits in (("busy", 1e6, 3), ("blend", 1e6, 3), ("cycles", 1e6, 3), ("joules", 1e-3, 2), ("um2", 1e6, 2))]
        print(f"| {name} | " + " | ".join(cells) + " |")
        names.append(one["machine"])
    clocked.say(names)


if __name__ == "__main__":
    command_line.run(main)
