#!/usr/bin/env python3
"""Writes a camera with each lens that captures have, as captures and as cameras.json.

usage: distorted.py CAMERAS.json FOLDER

FOLDER/NAME is a capture of one view, `a.png`, whose photograph is not there; FOLDER/own.json has the same lenses, one
view each. NAME is a model of COLMAP's in small letters, or nerfstudio, nerfstudio-fisheye and so on.
"""

import json
import os
import sys

CAMERAS, FOLDER = sys.argv[1:]
K1, K2, P1, P2, K3, K4, K5, K6 = 0.09, -0.06, 0.004, -0.006, -0.01, 0.02, 0.03, 0.01
RADIAL = {"k1": K1, "k2": K2}
BROWN = {**RADIAL, "p1": P1, "p2": P2}
FULL = {**BROWN, "k3": K3, "k4": K4, "k5": K5, "k6": K6, "camera_model": "FULL_OPENCV"}
FISH = {**RADIAL, "k3": K3, "k4": K4, "camera_model": "OPENCV_FISHEYE"}
# By COLMAP's name: whether there is one focal length, the coefficients in COLMAP's order, and what they are.
COLMAP = {
    "SIMPLE_RADIAL": (True, [K1], {"k1": K1}),
    "RADIAL": (True, [K1, K2], RADIAL),
    "OPENCV": (False, [K1, K2, P1, P2], BROWN),
    "FULL_OPENCV": (False, [K1, K2, P1, P2, K3, K4, K5, K6], FULL),
    "SIMPLE_DIVISION": (True, [K2], {"k": K2, "camera_model": "SIMPLE_DIVISION"}),
    "DIVISION": (False, [K1], {"k": K1, "camera_model": "DIVISION"}),
    "EUCM": (False, [0.6, 1.2], {"alpha": 0.6, "beta": 1.2, "camera_model": "EUCM"}),
    "OPENCV_FISHEYE": (False, [K1, K2, K3, K4], FISH),
    "SIMPLE_RADIAL_FISHEYE": (True, [K1], {"k1": K1, "camera_model": "SIMPLE_RADIAL_FISHEYE"}),
    "RADIAL_FISHEYE": (True, [K1, K2], {**RADIAL, "camera_model": "RADIAL_FISHEYE"}),
}
# nerfstudio's k4 is of r^8, but in a full model.
TRANSFORMS = {
    "nerfstudio": ({**BROWN, "k3": K3, "k4": K4}, {**BROWN, "k3": K3, "r8": K4}),
    "nerfstudio-fisheye": ({**RADIAL, "k3": K3, "k4": K4, "is_fisheye": True}, FISH),
    "nerfstudio-full": (FULL, FULL),
    "nerfstudio-sphere": ({"camera_model": "EQUIRECTANGULAR"}, {"camera_model": "EQUIRECTANGULAR"}),
}


def write(name, text):
    path = os.path.join(FOLDER, name)
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "w", encoding="utf-8") as f:
        f.write(text)


with open(CAMERAS, encoding="utf-8") as f:
    view = json.load(f)[0]
focal, fy, cx, cy = view["fx"], view["fx"] * 1.05, view["width"] / 2 - 3, view["height"] / 2 + 2
axes, position = view["rotation"], view["position"]
assert axes == [[1, 0, 0], [0, 1, 0], [0, 0, 1]], "poses are not what this is about"
size = f"{view['width']} {view['height']}"
own = []


def add(name, one_focal, lens):
    own.append({**view, "id": len(own), "img_name": name, "fx": focal, "fy": focal if one_focal else fy, "cx": cx,
                "cy": cy, **lens})


for model, (one_focal, terms, lens) in COLMAP.items():
    numbers = [focal] if one_focal else [focal, fy]
    write(f"{model.lower()}/sparse/0/cameras.txt",
          f"1 {model} {size} " + " ".join(map(repr, numbers + [cx, cy] + terms)) + "\n")
    write(f"{model.lower()}/sparse/0/images.txt",
          "1 1 0 0 0 " + " ".join(repr(-p) for p in position) + " 1 a.png\n\n")
    add(model.lower(), one_focal, lens)
for name, (terms, lens) in TRANSFORMS.items():
    pose = [[1, 0, 0, position[0]], [0, -1, 0, position[1]], [0, 0, -1, position[2]], [0, 0, 0, 1]]
    write(f"{name}/transforms.json", json.dumps({
        "fl_x": focal, "fl_y": fy, "cx": cx, "cy": cy, "w": view["width"], "h": view["height"], **terms,
        "frames": [{"file_path": "a.png", "transform_matrix": pose}]}))
    add(name, False, lens)
write("own.json", json.dumps(own))
