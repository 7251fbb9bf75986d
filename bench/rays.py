#!/usr/bin/env python3
"""How near `splat render --renderer ray`, `surfel` or `trace` comes to the fp64 reference: tables of docs/tables.

usage: bench/rays.py [--renderer ray|surfel|trace] [--cycles] [--width PIXELS] [--only WORD] [-o FOLDER]

Draws all views beside the repository (scenes.py) on all paths that the renderer has, and gives their PSNR beside
`splat-reference --along-rays --dilation 0`, in the order along rays for traced ones: over all pixels, outside of doubtful
ones, whose share it prints, and of footprints over all pixels. Of traced rays it prints what a ray takes, too.
--cycles prints the cycles of frames instead, of footprints, rays and traced rays, these by --ray-window, and memory.
--only measures the views whose names have WORD in them. FOLDER keeps results (docs/studies.md). Exit codes: 0 done, 1 a
picture is below the bound outside of doubtful pixels.
"""

import argparse
import os

import command_line
import scenes
from accuracy import Bench, db, decibels, reached

# Paths of a renderer, and what the reference takes.
RENDERERS = {"ray": (("raster", "simt"), ()), "surfel": (("raster", "simt"), ("--surfels",)),
             "trace": (("simt",), ("--order", "ray"))}
NAMES = {"raster": "rasterizer", "simt": "cores"}
SURE_DB = 100
WINDOWS = ("4", "8", "16")
CYCLES = ("footprints, rasterizer", "cores", "rays, rasterizer", "cores", *(f"traced, {window} hits a pass" for window in WINDOWS),
          *(f"restarts, {window}" for window in WINDOWS), "MB, rays", "MB, traced")


def work_of(rays):
    """What a ray takes: boxes, Gaussians evaluated and blended, restarts."""
    return "".join(f" | {rays[what] / rays['rays']:,.1f}" for what in ("nodes", "evaluated", "blended", "restarts"))


def row(bench, scene, view, renderer):
    paths, reference = RENDERERS[renderer]
    name = f"{renderer}-{scene.name}-{view}"
    source = ("{scene}", "--cameras", "{cameras}", "--view", view)
    inputs = {"scene": scene.path, "cameras": scene.cameras}
    _, exact = bench.run(f"{name}-f64", inputs, "splat-reference", *source, "--along-rays", *reference, "--dilation", "0",
                         "-o", "{out}.npz", keep=(".npz",))

    def compared(what, *options):
        report, picture = bench.run(f"{name}-{what}", inputs, "splat", "render", *source, *options, "-o", "{out}.npz",
                                    "--json", "{out}.json", keep=(".npz",))
        return bench.compare(f"{name}-{what}-compared", exact, picture, exact), report

    drawn = [compared(path, "--renderer", renderer, "--path", path) for path in paths]
    rays = [result for result, _ in drawn]
    footprints, _ = compared("footprints", "--dilation", "0")
    print(f"| {scene.name.rsplit('-', 1)[0]}, {view} | {100 * rays[0]['doubtful_share']:.2f} % | "
          + " | ".join(f"{db(decibels(r))} | {db(decibels(r, '_outside_doubtful'))}" for r in rays)
          + f" | {db(decibels(footprints))}" + (work_of(drawn[0][1]["report"]["rays"]) if renderer == "trace" else "") + " |", flush=True)
    return all(reached(decibels(r, "_outside_doubtful"), SURE_DB) for r in rays)


def cycles(bench, scene, view, _):
    """The cycles of a frame by renderer and path, of traced rays by the window, with what these take."""
    name = f"cycles-{scene.name}-{view}"
    source = ("{scene}", "--cameras", "{cameras}", "--view", view)
    inputs = {"scene": scene.path, "cameras": scene.cameras}

    def drawn(what, *options):
        result, = bench.run(f"{name}-{what}", inputs, "splat", "render", *source, *options, "-o", "{out}.npz", "--json",
                            "{out}.json", "--time")
        return result["report"]

    frames = [drawn("splat", "--dilation", "0"), drawn("splat-simt", "--dilation", "0", "--path", "simt"),
              drawn("ray", "--renderer", "ray"), drawn("ray-simt", "--renderer", "ray", "--path", "simt")]
    traced = [drawn(f"trace-{window}", "--renderer", "trace", "--path", "simt", "--ray-window", window) for window in WINDOWS]
    whole = traced[-1]["rays"]
    print(f"| {scene.name.rsplit('-', 1)[0]}, {view} | "
          + " | ".join(f"{frame['time']['sum']['cycles']:,}" for frame in frames + traced) + " | "
          + " | ".join(f"{frame['rays']['restarts'] / whole['rays']:.2f}" for frame in traced)
          + f" | {frames[3]['counts']['device_bytes'] / 1e6:,.1f} | {traced[-1]['counts']['device_bytes'] / 1e6:,.1f} |", flush=True)
    return True


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--renderer", choices=RENDERERS, default="ray")
    parser.add_argument("--cycles", action="store_true")
    parser.add_argument("--width", type=int, default=224)
    parser.add_argument("--only", default="")
    parser.add_argument("-o", dest="out", default=os.path.join(scenes.ROOT, "build", "rays"))
    args = parser.parse_args()
    args.data = ""
    bench = Bench(args)
    paths, _ = RENDERERS[args.renderer]
    work = ("boxes a ray", "evaluated", "blended", "restarts") if args.renderer == "trace" else ()
    sure = (f"{NAMES[path]}, all, dB | sure, dB" for path in paths)
    heading = "| view | " + " | ".join(CYCLES if args.cycles else ("doubtful", *sure, "footprints, dB", *work)) + " |"
    print(heading + "\n|---" + "|--:" * (heading.count("|") - 2) + "|")
    line = cycles if args.cycles else row
    good = True
    for known in scenes.known():
        scene = scenes.at_width(scenes.shared(known), args.width, args.out)
        for view in scene.views:
            if args.only in f"{known}, {view}":
                good &= line(bench, scene, view, args.renderer)
    return 0 if good else 1


if __name__ == "__main__":
    command_line.run(main)
