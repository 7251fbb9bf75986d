#!/usr/bin/env python3
"""How near `splat render --renderer ray` comes to the fp64 reference: a table of docs/tables/cameras.md.

usage: bench/rays.py [--width PIXELS] [--only WORD] [-o FOLDER]

Draws all views beside the repository (scenes.py) on both paths, and gives their PSNR beside `splat-reference --along-rays
--dilation 0`: over all pixels, outside of doubtful ones, whose share it prints, and of footprints over all pixels.
--only measures the views whose names have WORD in them. FOLDER keeps results (docs/studies.md). Exit codes: 0 done, 1 a
picture is below the bound outside of doubtful pixels.
"""

import argparse
import os

import command_line
import scenes
from accuracy import Bench, db, decibels, reached

PATHS = ("raster", "simt")
SURE_DB = 100


def row(bench, scene, view):
    name = f"rays-{scene.name}-{view}"
    source = ("{scene}", "--cameras", "{cameras}", "--view", view)
    inputs = {"scene": scene.path, "cameras": scene.cameras}
    _, exact = bench.run(f"{name}-f64", inputs, "splat-reference", *source, "--along-rays", "--dilation", "0", "-o", "{out}.npz",
                         keep=(".npz",))

    def compared(what, *options):
        _, picture = bench.run(f"{name}-{what}", inputs, "splat", "render", *source, *options, "-o", "{out}.npz", keep=(".npz",))
        return bench.compare(f"{name}-{what}-compared", exact, picture, exact)

    rays = [compared(path, "--renderer", "ray", "--path", path) for path in PATHS]
    footprints = compared("footprints", "--dilation", "0")
    print(f"| {scene.name.rsplit('-', 1)[0]}, {view} | {100 * rays[0]['doubtful_share']:.2f} % | "
          + " | ".join(f"{db(decibels(r))} | {db(decibels(r, '_outside_doubtful'))}" for r in rays)
          + f" | {db(decibels(footprints))} |", flush=True)
    return all(reached(decibels(r, "_outside_doubtful"), SURE_DB) for r in rays)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--width", type=int, default=224)
    parser.add_argument("--only", default="")
    parser.add_argument("-o", dest="out", default=os.path.join(scenes.ROOT, "build", "rays"))
    args = parser.parse_args()
    args.data = ""
    bench = Bench(args)
    print("| view | doubtful | rasterizer, all, dB | sure, dB | cores, all, dB | sure, dB | footprints, dB |\n"
          "|---|--:|--:|--:|--:|--:|--:|")
    good = True
    for known in scenes.known():
        scene = scenes.at_width(scenes.shared(known), args.width, args.out)
        for view in scene.views:
            if args.only in f"{known}, {view}":
                good &= row(bench, scene, view)
    return 0 if good else 1


if __name__ == "__main__":
    command_line.run(main)
