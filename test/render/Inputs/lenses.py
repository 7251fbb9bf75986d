#!/usr/bin/env python3
"""Writes a view of each camera model, from the first view of another file.

usage: lenses.py CAMERAS.json OUT.json
opencv, fold, pincushion, division, simple-division (a crop), eucm, eucm-crop, fisheye, around, orthographic, sphere, turned (a
sphere that looks back, so that its seam is where the first view looks),
rolling and bent (a pinhole and a fisheye that move while they expose)
"""

import json
import math
import sys


def main(source, target):
    with open(source) as file:
        first = json.load(file)[0]
    width, height, focal = first["width"], first["height"], first["fx"]
    sphere = {"camera_model": "EQUIRECTANGULAR", "width": 2 * height}
    back = [[-row[0], row[1], -row[2]] for row in first["rotation"]]
    views = {
        "opencv": {"camera_model": "FULL_OPENCV", "k1": -0.25, "k2": 0.08, "k3": -0.01, "k4": 0.02, "k5": 0.03,
                   "k6": 0.01, "p1": 0.004, "p2": -0.006, "s1": 0.003, "s2": -0.001, "s3": 0.002, "s4": 0.001},
        "fold": {"dist_coeffs": [-0.6], "fx": 0.7 * focal, "fy": 0.6 * focal, "cx": 0.4 * width},
        "pincushion": {"k1": 0.2},
        "division": {"camera_model": "DIVISION", "k": -0.3},
        "simple-division": {"camera_model": "SIMPLE_DIVISION", "k": 0.1, "cx": 1.2 * width},
        "eucm": {"camera_model": "EUCM", "alpha": 0.6, "beta": 1.2, "fx": 0.6 * focal, "fy": 0.5 * focal},
        "eucm-crop": {"camera_model": "EUCM", "alpha": 1, "beta": 0.5, "cx": 1.2 * width},
        "fisheye": {"camera_model": "OPENCV_FISHEYE", "k1": 0.06, "k2": -0.02, "k3": 0.005, "k4": -0.0006},
        "around": {"is_fisheye": True, "fx": height / 6, "fy": height / 6},
        "orthographic": {"camera_model": "ORTHOGRAPHIC", "fx": focal / 3, "fy": focal / 3},
        "sphere": sphere,
        "turned": {**sphere, "rotation": back},
        "rolling": {"rolling_shutter": "ROLLING_TOP_TO_BOTTOM", "rolling_motion": [0.2, -0.1, 0.1],
                    "rolling_turn": [0.05, 0.1, -0.1]},
        "bent": {"camera_model": "OPENCV_FISHEYE", "k1": 0.06, "rolling_shutter": [0.9, -0.2, -0.6],
                 "rolling_motion": [-0.1, 0.2, 0], "rolling_turn": [0.1, -0.2, 0.05]},
    }
    records = [{**first, "id": number, "img_name": name, **lens} for number, (name, lens) in enumerate(views.items())]
    with open(target, "w") as file:
        json.dump(records, file)


main(*sys.argv[1:])
