#!/usr/bin/env python3
"""How near `splat render --renderer ray`, `surfel` or `trace` comes to the fp64 reference: tables of docs/tables.

usage: bench/rays.py [--renderer ray|surfel|trace] [--costs] [--width PIXELS] [--only WORD] [-o FOLDER]

Draws all views beside the repository (scenes.py) on all paths that the renderer has, and gives their PSNR beside
`splat-reference --along-rays --dilation 0`, in the order along rays for traced ones: over all pixels, outside of doubtful
ones, whose share it prints, and of footprints over all pixels. Of traced rays it prints what a ray takes, too.
--costs prints instead what frames cost: cycles, the chip's energy, error and memory of footprints, rays, surfels and traced
rays, these by --ray-window and --ray-restart.
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
# Renderers and paths whose frames are compared: heading, renderer, path, options.
COSTED = (("footprints, rasterizer", "footprints", "raster", ()), ("cores", "footprints", "simt", ()),
          ("rays, rasterizer", "ray", "raster", ()), ("cores", "ray", "simt", ()),
          ("surfels, rasterizer", "surfel", "raster", ()), ("cores", "surfel", "simt", ()),
          *((f"traced, {window} hits a pass", "trace", "simt", ("--ray-window", window)) for window in WINDOWS),
          ("with checkpoints", "trace", "simt", ("--ray-window", WINDOWS[-1], "--ray-restart", "checkpoint")))
# What is said of a frame, by its report and its comparison with the reference.
COSTS = {
    "cycles": lambda report, _: f"{report['time']['sum']['cycles']:,}",
    "chip, mJ": lambda report, _: f"{1e3 * report['energy']['chip_joules']['value']:,.3g}",
    "sure, dB": lambda _, compared: db(decibels(compared, "_outside_doubtful")),
    "MB": lambda report, _: f"{report['counts']['device_bytes'] / 1e6:,.1f}",
    "restarts": lambda report, _: f"{report['rays']['restarts'] / report['rays']['rays']:.2f}" if "rays" in report else "",
}


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


def costs(bench, scene, view, _):
    """What a frame costs by renderer and path, of traced rays by the window and restarts: a row for each of COSTS."""
    name = f"costs-{scene.name}-{view}"
    source = ("{scene}", "--cameras", "{cameras}", "--view", view)
    inputs = {"scene": scene.path, "cameras": scene.cameras}
    exact, frames = {}, []
    for _, of, path, options in COSTED:
        if of not in exact:
            rules = ("--along-rays", *RENDERERS[of][1]) if of in RENDERERS else ()
            _, exact[of] = bench.run(f"{name}-{of}-f64", inputs, "splat-reference", *source, *rules, "--dilation", "0", "-o",
                                     "{out}.npz", keep=(".npz",))
        drawn = ("--renderer", of) if of in RENDERERS else ("--dilation", "0")
        run = f"{name}-{of}-{path}{''.join(options)}"
        result, picture = bench.run(run, inputs, "splat", "render", *source, *drawn, "--path", path, *options, "-o",
                                    "{out}.npz", "--json", "{out}.json", "--time", "--energy", keep=(".npz",))
        frames.append((result["report"], bench.compare(f"{run}-compared", exact[of], picture, exact[of])))
    for what, value in COSTS.items():
        print(f"| {scene.name.rsplit('-', 1)[0]}, {view} | {what} | " + " | ".join(value(*frame) for frame in frames) + " |",
              flush=True)
    return True


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--renderer", choices=RENDERERS, default="ray")
    parser.add_argument("--costs", action="store_true")
    parser.add_argument("--width", type=int, default=224)
    parser.add_argument("--only", default="")
    parser.add_argument("-o", dest="out", default=os.path.join(scenes.ROOT, "build", "rays"))
    args = parser.parse_args()
    args.data = ""
    bench = Bench(args)
    paths, _ = RENDERERS[args.renderer]
    work = ("boxes a ray", "evaluated", "blended", "restarts") if args.renderer == "trace" else ()
    sure = (f"{NAMES[path]}, all, dB | sure, dB" for path in paths)
    costed = ("what", *(what for what, *_ in COSTED))
    heading = "| view | " + " | ".join(costed if args.costs else ("doubtful", *sure, "footprints, dB", *work)) + " |"
    print(heading + "\n|---" + "|--:" * (heading.count("|") - 2) + "|")
    line = costs if args.costs else row
    good = True
    for known in scenes.known():
        scene = scenes.at_width(scenes.shared(known), args.width, args.out)
        for view in scene.views:
            if args.only in f"{known}, {view}":
                good &= line(bench, scene, view, args.renderer)
    return 0 if good else 1


if __name__ == "__main__":
    command_line.run(main)
