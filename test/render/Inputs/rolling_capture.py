#!/usr/bin/env python3
"""Writes a capture of eight views beside the first of INRIA's cameras, whose fisheye moves and turns while it exposes
row after row, as instant-ngp writes it (rolling); one that says nothing of that (still); and one of full spheres
(sphere). Photographs are to come. Their points are the means of the Gaussians in SCENE.ply.

usage: rolling_capture.py SCENE.ply CAMERAS.json FOLDER
"""

import json
import math
import os
import struct
import sys

SCENE, CAMERAS, FOLDER = sys.argv[1:]
WIDTH, HEIGHT, VIEWS = 120, 80, 8
with open(CAMERAS, encoding="utf-8") as f:
    view = json.load(f)[0]
axes, (x, y, z) = view["rotation"], view["position"]


def pose(step, turn):
    """Beside the camera by step, turned about its own y axis; columns x, -y and -z as in transforms.json."""
    cos, sin = math.cos(turn), math.sin(turn)
    right = [axes[i][0] * cos - axes[i][2] * sin for i in range(3)]
    ahead = [axes[i][0] * sin + axes[i][2] * cos for i in range(3)]
    place = [(x, y, z)[i] + step * axes[i][0] for i in range(3)]
    return [[right[i], -axes[i][1], -ahead[i], place[i]] for i in range(3)] + [[0, 0, 0, 1]]


def points():
    """Places and colours, as the lines of a PLY file."""
    with open(SCENE, "rb") as file:
        header, data = file.read().split(b"end_header\n", 1)
    names = [line.split()[2].decode() for line in header.splitlines() if line.startswith(b"property")]
    for values in struct.iter_unpack(f"<{len(names)}f", data):
        of = dict(zip(names, values))
        colour = [round(255 * min(max(0.5 + 0.2821 * of[f"f_dc_{k}"], 0), 1)) for k in range(3)]
        yield " ".join(map(str, [of["x"], of["y"], of["z"], *colour]))


cloud = list(points())
rolling, still = [], []
for n in range(VIEWS):
    step, turn = 0.1 * (n - 4), 0.02 * (n % 3 - 1)
    way = 1 if n % 2 else -1  # so that no scene can take the shear upon itself
    rolling.append({"file_path": str(n), "transform_matrix": pose(step, turn),
                    "transform_matrix_start": pose(step - 0.05 * way, turn - 0.1 * way),
                    "transform_matrix_end": pose(step + 0.05 * way, turn + 0.1 * way)})
    still.append({"file_path": str(n), "transform_matrix": pose(step, turn)})
lens = {"fl_x": 70, "fl_y": 71, "cx": 59, "cy": 41, "w": WIDTH, "h": HEIGHT, "camera_model": "OPENCV_FISHEYE",
        "k1": 0.05, "k2": -0.01, "k3": 0.002, "k4": -0.0003}
for name, frames, camera in (("rolling", rolling, {**lens, "rolling_shutter": [0, 0, 1, 0]}), ("still", still, lens),
                             ("sphere", still, {"w": WIDTH, "h": WIDTH // 2, "camera_model": "EQUIRECTANGULAR"})):
    folder = os.path.join(FOLDER, name)
    os.makedirs(folder)
    with open(os.path.join(folder, "transforms.json"), "w", encoding="utf-8") as f:
        json.dump({**camera, "ply_file_path": "points.ply", "frames": frames}, f)
    with open(os.path.join(folder, "points.ply"), "w", encoding="ascii") as f:
        f.write(f"ply\nformat ascii 1.0\nelement vertex {len(cloud)}\n")
        f.write("".join(f"property float {k}\n" for k in "xyz"))
        f.write("".join(f"property uchar {k}\n" for k in ("red", "green", "blue")) + "end_header\n")
        f.write("\n".join(cloud) + "\n")
