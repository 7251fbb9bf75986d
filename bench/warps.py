#!/usr/bin/env python3
"""What two and four warps a core are worth on a view: cycles, energy and area beside one warp, on several machines (docs/ideas.md).

usage: warps.py SCENE --cameras FILE --view NAME [--path simt]

Prints rows of a Markdown table. Every machine draws the same bits, or the program ends with an error.
"""

import argparse
import os
import sys

import clocked
import command_line
import study
import timed_frame

MACHINES = ("prototype", "prototype-forwarding", "scaled")
WARPS = (1, 2, 4)
STAGES = ("project", "sort by depth")


def point(args, machine, warps):
    unit = ("--exp", "table") if args.path == "raster" else ()
    return study.render(f"{machine}-{warps}", timed_frame.scene_of(args), args.view, *unit, "--energy", "--path", args.path,
                        VORION_CONFIG=machine, VORION_SET=f"warps_per_core={warps}")


def figures(found):
    stages = {stage["name"]: stage["time"]["cycles"] for stage in found["time"]["stages"] if "time" in stage}
    return {"machine": clocked.name(found["time"]["sum"]), "picture": found["result_fnv1a64"], "fps": found["time"]["fps"],
            **{name: stages[name] for name in STAGES},
            "cycles": found["time"]["sum"]["cycles"], "joules": found["energy"]["chip_joules"]["value"],
            "um2": found["energy"]["area"]["chip_um2"]["value"]}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    timed_frame.add_view(parser)
    parser.add_argument("--path", default="raster", help="as of splat render")
    args = parser.parse_args()
    scene = os.path.basename(args.scene).split(".")[0]
    print("| scene, view | machine | warps | frames/s | frame | `project` | sort by depth | chip, mJ | chip, mm2 |\n"
          "|---|---|--:|--:|--:|--:|--:|--:|--:|")
    tried = [(machine, warps) for machine in MACHINES for warps in WARPS]
    picture, names, base = None, [], None
    for (machine, warps), found in zip(tried, study.reports([point(args, *one) for one in tried]), strict=True):
        one = figures(found)
        picture = picture or one["picture"]
        if picture != one["picture"]:
            sys.exit(f"warps.py: error: {machine}, {warps} warps: another picture, expected the same bits")
        base = one if warps == WARPS[0] else base
        names.append(one["machine"])
        cells = [f"{one[key] / scale:.{digits}f}" if one is base else f"{100 * (one[key] / base[key] - 1):+.1f} %"
                 for key, scale, digits in (("cycles", 1e6, 3), *((name, 1e6, 3) for name in STAGES),
                                            ("joules", 1e-3, 2), ("um2", 1e6, 2))]
        print(f"| {scene} {args.view} | `{machine}` | {warps} | {one['fps']:.1f} | " + " | ".join(cells) + " |")
    clocked.say(names)


if __name__ == "__main__":
    command_line.run(main)
