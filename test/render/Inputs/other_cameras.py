#!/usr/bin/env python3
"""Writes the first of INRIA's cameras as other programs would.

usage: other_cameras.py CAMERAS.json FOLDER
"""

import json
import math
import os
import sys

CAMERAS, FOLDER = sys.argv[1:]
WIDTH, HEIGHT = 96, 54


def write(name, text):
    path = os.path.join(FOLDER, name)
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "w", encoding="utf-8") as f:
        f.write(text)


def quaternion(r):
    """Of a rotation with a positive trace, or about x, y or z by half a turn."""
    w = math.sqrt(max(0, 1 + r[0][0] + r[1][1] + r[2][2])) / 2
    x, y, z = (math.copysign(math.sqrt(max(0, 1 + 2 * r[i][i] - r[0][0] - r[1][1] - r[2][2])) / 2, d)
               for i, d in ((0, r[2][1] - r[1][2]), (1, r[0][2] - r[2][0]), (2, r[1][0] - r[0][1])))
    return w, x, y, z


with open(CAMERAS, encoding="utf-8") as f:
    view = json.load(f)[0]
scale = WIDTH / view["width"]
focal = view["fx"] * scale
rotation, position = view["rotation"], view["position"]
view |= {"width": WIDTH, "height": HEIGHT, "fx": focal, "fy": focal, "cx": WIDTH / 2, "cy": HEIGHT / 2}
write("inria.json", json.dumps([view]))

world_to_camera = [[rotation[k][i] for k in range(3)] for i in range(3)]
translation = [-sum(row[k] * position[k] for k in range(3)) for row in world_to_camera]
q = quaternion(world_to_camera)
write("colmap/sparse/0/cameras.txt", f"1 PINHOLE {WIDTH} {HEIGHT} {focal!r} {focal!r} {WIDTH / 2} {HEIGHT / 2}\n")
write("colmap/sparse/0/images.txt", "1 " + " ".join(repr(v) for v in (*q, *translation)) + " 1 left/front.jpg\n\n")

opengl = [[rotation[i][0], -rotation[i][1], -rotation[i][2], position[i]] for i in range(3)] + [[0, 0, 0, 1]]
write("transforms.json", json.dumps({"fl_x": focal, "w": WIDTH, "h": HEIGHT,
                                     "frames": [{"file_path": "left/front.jpg", "transform_matrix": opengl}]}))
write("path.json", json.dumps({"camera_type": "perspective", "render_width": WIDTH, "render_height": HEIGHT, "camera_path": [
    {"camera_to_world": sum(opengl, []), "fov": math.degrees(2 * math.atan(HEIGHT / 2 / focal))}]}))
write("none.json", "{}")
