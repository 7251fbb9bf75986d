#!/usr/bin/env python3
"""What z-tiles and the pixel unit do to a view: picture error and work.

Renders a view with --ztiles K, with and without the early stop (--cutoff 0),
and with --pixel-unit rules, and prints for each: the largest difference from
the whole list's picture and its PSNR, blends in all and relative to the whole
list's, lane slots of the rasterizers, and what the pixel unit took over.

usage: hand_over.py SCENE --cameras CAMERAS --view VIEW --out FOLDER [--json FILE] [OPTIONS of splat render]

FOLDER keeps each run's result; what is there is not run again.
"""

import math

import command_line
import frames

PARTS = (1, 2, 4, 8, 16)
RULES = ("last:1/2", "last:1/4", "last:1/8", "count:256", "occluded:0.5", "occluded:0.9", "occluded:0.99")


def row(name, counters, picture, whole):
    base, right = whole
    largest, mean = frames.difference(right, picture)
    blends = counters["raster_blends"] + counters["raster_tail_blends"]
    return {"run": name, "max_abs": largest,
            "db": -10 * math.log10(mean) if mean else None,
            "blends": blends, "blend_ratio": blends / (base["raster_blends"] + base["raster_tail_blends"]),
            **{key: counters["raster_" + key] for key in
               ("commands", "gaussians", "intersecting", "fragments", "tails", "tail_pixels", "tail_visits",
                "tail_blends")}}


def main():
    args = frames.parse_arguments(__doc__.splitlines()[0])
    # By what the table calls them: options, and the run whose picture is the right one.
    runs = {f"{stop}, K={parts}": ([*options, "--ztiles", str(parts)], f"{stop}, K=1")
            for stop, options in (("stop", []), ("no stop", ["--cutoff", "0"])) for parts in PARTS}
    runs |= {rule: (["--pixel-unit", rule], "stop, K=1") for rule in RULES}
    runs["skip saturated"] = ["--skip-saturated"], "stop, K=1"
    found = {name: (report["total"]["counters"], frames.floats(picture)) for name, (report, picture)
             in frames.render(args, {name: options for name, (options, _) in runs.items()}).items()}
    rows = [row(name, *found[name], found[whole]) for name, (_, whole) in runs.items()]
    print(f"{'run':<16} {'max diff':>9} {'dB':>7} {'blends':>11} {'ratio':>6} {'lane slots':>11} "
          f"{'tails':>6} {'pixels':>8} {'visits':>12} {'tail blends':>11}")
    for r in rows:
        db = "equal" if r["db"] is None else f"{r['db']:.2f}"
        print(f"{r['run']:<16} {r['max_abs']:>9.2e} {db:>7} {r['blends']:>11} {r['blend_ratio']:>6.3f} "
              f"{r['fragments']:>11} {r['tails']:>6} {r['tail_pixels']:>8} {r['tail_visits']:>12} "
              f"{r['tail_blends']:>11}")
    frames.write_table(args, {"rows": rows})


if __name__ == "__main__":
    command_line.run(main)
