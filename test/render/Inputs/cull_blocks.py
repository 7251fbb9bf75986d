#!/usr/bin/env python3
"""Draws a scene with and without --cull-blocks, in several ways: pictures, Gaussians seen and pairs must be the same.

usage: cull_blocks.py SCENE CAMERAS
"""

import json
import subprocess
import sys

WAYS = ["--path raster", "--path simt", "--support box3", "--support square3", "--path simt --support official16",
        "--rules gsplat", "--rules gsplat --support square3 --tile 16", "--near 3", "--alpha-cutoff 4", "--path simt --tile 8"]


def draw(name, options):
    """The picture, the counts and the warp instructions of the stage project."""
    subprocess.run(["splat", "render", sys.argv[1], "--cameras", sys.argv[2], "--view", "front", "-o", name + ".pfm",
                    "--json", name + ".json", *options], check=True, stdout=subprocess.DEVNULL)
    with open(name + ".json", encoding="utf-8") as file:
        said = json.load(file)
    with open(name + ".pfm", "rb") as file:
        picture = file.read()
    stage = next(stage for stage in said["stages"] if stage["name"] == "project")
    instructions = sum(kernel["counters"]["warp_instructions"] for kernel in stage["kernels"])
    return picture, (said["counts"]["visible"], said["counts"]["pairs"]), instructions


for way in WAYS:
    options = way.split()
    whole, culled = draw("whole", options), draw("culled", [*options, "--cull-blocks"])
    for what, a, b in zip(("the picture", "Gaussians and pairs"), whole, culled):
        if a != b:
            sys.exit(f"{way}: {what} not the same with --cull-blocks")
    print(f"{way}: {culled[1][0]} Gaussians seen, project executes {100 * culled[2] / whole[2]:.0f} %")
print(f"{len(WAYS)} pictures, all the same with --cull-blocks")
