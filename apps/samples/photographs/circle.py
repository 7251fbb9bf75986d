#!/usr/bin/env python3
"""Photographs a scene from a circle, for want of a camera and a place.

FOLDER gets a picture of each of VIEWS (24) views, rendered by splat, and transforms.json with the poses, as
`splat train FOLDER` reads them.
"""
import argparse
import json
import math
import os
import subprocess
import sys

WIDTH, HEIGHT, FOCAL = 120, 80, 110  # pixels
RADIUS, RISE = 4.0, 1.6  # of the circle around the origin, in the scene's units; y points up


def unit(v):
    length = math.sqrt(sum(x * x for x in v))
    return [x / length for x in v]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def axes(position):
    """Right, down and forward of a camera that looks at the origin."""
    forward = unit([-x for x in position])
    right = unit(cross(forward, [0, 1, 0]))
    return right, cross(forward, right), forward


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene", metavar="SCENE.ply")
    parser.add_argument("folder", metavar="FOLDER")
    parser.add_argument("views", metavar="VIEWS", type=int, nargs="?", default=24)
    options = parser.parse_args()
    scene, folder, views = options.scene, options.folder, options.views
    os.makedirs(folder, exist_ok=True)
    cameras, frames = [], []
    for n in range(views):
        angle = 2 * math.pi * n / views
        position = [RADIUS * math.sin(angle), RISE, RADIUS * math.cos(angle)]
        right, down, forward = axes(position)
        name = f"view{n:02}"
        # As INRIA's trainer writes it: the columns of the rotation are the camera's axes.
        cameras.append({"id": n, "img_name": name, "width": WIDTH, "height": HEIGHT, "fx": FOCAL, "fy": FOCAL,
                        "position": position, "rotation": [list(row) for row in zip(right, down, forward)]})
        # As transforms.json has it: y points up, and z to the back.
        matrix = [[right[i], -down[i], -forward[i], position[i]] for i in range(3)] + [[0, 0, 0, 1]]
        frames.append({"file_path": f"picture.{name}.png", "transform_matrix": matrix})
    with open(f"{folder}/cameras.json", "w", encoding="utf-8") as file:
        json.dump(cameras, file)
    with open(f"{folder}/transforms.json", "w", encoding="utf-8") as file:
        json.dump({"w": WIDTH, "h": HEIGHT, "fl_x": FOCAL, "fl_y": FOCAL, "cx": WIDTH / 2, "cy": HEIGHT / 2,
                   "frames": frames}, file)
    drawn = subprocess.run(["splat", "render", scene, "--cameras", f"{folder}/cameras.json", "--view", "all", "-o",
                            f"{folder}/picture.png"], check=False, stdout=subprocess.DEVNULL)
    if drawn.returncode:
        sys.exit(drawn.returncode)  # splat has said why
    print(f"{views} pictures of {WIDTH}x{HEIGHT} pixels")


main()
