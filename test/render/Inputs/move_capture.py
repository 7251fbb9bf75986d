#!/usr/bin/env python3
"""Copies a COLMAP capture of text files, moved by an offset.

usage: move_capture.py FROM TO DX DY DZ
"""

import shutil
import sys

source, target = sys.argv[1:3]
offset = [float(v) for v in sys.argv[3:6]]
shutil.copytree(source, target)


def rewrite(name, change):
    path = f"{target}/sparse/0/{name}"
    lines = [line.split() for line in open(path)]
    with open(path, "w") as out:
        for fields in lines:
            if fields and fields[0] != "#":
                change(fields)
            print(*fields, file=out)


def move_image(fields):
    """World to camera: t becomes t - R offset."""
    if len(fields) != 10:
        return  # the points that the image sees
    w, x, y, z = (float(v) for v in fields[1:5])
    n = 2 / (w * w + x * x + y * y + z * z)
    rows = [[1 - n * (y * y + z * z), n * (x * y - w * z), n * (x * z + w * y)],
            [n * (x * y + w * z), 1 - n * (x * x + z * z), n * (y * z - w * x)],
            [n * (x * z - w * y), n * (y * z + w * x), 1 - n * (x * x + y * y)]]
    for k, row in enumerate(rows):
        fields[5 + k] = repr(float(fields[5 + k]) - sum(r * d for r, d in zip(row, offset)))


def move_point(fields):
    for k, d in enumerate(offset):
        fields[1 + k] = repr(float(fields[1 + k]) + d)


rewrite("images.txt", move_image)
rewrite("points3D.txt", move_point)
