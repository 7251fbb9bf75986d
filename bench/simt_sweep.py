#!/usr/bin/env python3
"""Finds the fastest of the kernels that blend without the rasterizer.

Renders a view with --path simt over tiles of {8, 16, 32, 64} pixels and groups
of {16, 64, 256} work-items, checks that all give the same bits, and prints warp
instructions: of the blend kernel, the same for each blend (a Gaussian blended
into a pixel), and of the whole frame. Blends are counted by --path raster.

usage: simt_sweep.py SCENE --cameras CAMERAS --view VIEW --out FOLDER [--json FILE] [OPTIONS of splat render]

FOLDER keeps each run's result; what is there is not run again.
"""

import sys

import command_line
import frames

TILES = (8, 16, 32, 64)
GROUPS = (16, 64, 256)


def kernel(report, name):
    kernels = [k for s in report["stages"] for k in s["kernels"] if k["name"] == name]
    return sum(k["counters"]["warp_instructions"] for k in kernels)


def main():
    args = frames.parse_arguments(__doc__.splitlines()[0])

    kernels = {(tile, group): ["--path", "simt", "--tile", str(tile), "--simt-group", str(group)]
               for tile in TILES for group in GROUPS}
    found = frames.render(args, {"raster": ["--path", "raster"],
                                 **{f"simt-{tile}-{group}": options for (tile, group), options in kernels.items()}})
    raster, _ = found["raster"]
    blends = raster["total"]["counters"]["raster_blends"]
    rows, pictures = [], set()
    for tile, group in kernels:
        report, _ = found[f"simt-{tile}-{group}"]
        pictures.add(report["result_fnv1a64"])
        blend = kernel(report, "blend")
        rows.append({"tile": tile, "group": group, "blend_warp_instructions": blend,
                     "per_blend": blend / blends, "pairs": report["counts"]["pairs"],
                     "frame_warp_instructions": report["total"]["counters"]["warp_instructions"]})
    best = min(rows, key=lambda r: r["blend_warp_instructions"])
    best_frame = min(rows, key=lambda r: r["frame_warp_instructions"])
    print(f"{blends} blends; warp instructions")
    print(f"{'tile':>4} {'group':>5} {'blend kernel':>14} {'a blend':>8} {'frame':>14} {'pairs':>10}")
    for r in rows:
        note = " fastest blend" * (r is best) + " fastest frame" * (r is best_frame)
        print(f"{r['tile']:>4} {r['group']:>5} {r['blend_warp_instructions']:>14} {r['per_blend']:>8.3f} "
              f"{r['frame_warp_instructions']:>14} {r['pairs']:>10}{note}")
    frames.write_table(args, {"blends": blends, "device": raster["device"], "rows": rows, "best": best,
                              "best_frame": best_frame})
    if len(pictures) != 1:
        sys.exit("simt_sweep.py: error: the pictures differ, expected the same bits for every tile and group")


if __name__ == "__main__":
    command_line.run(main)
