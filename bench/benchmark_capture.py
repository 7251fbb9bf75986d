#!/usr/bin/env python3
"""Photographs of a scene of the benchmark set, with poses and points: a capture for training at the size of the paper's.

usage: bench/benchmark_capture.py [--scene NAME] [--pictures N] [--size WIDTHxHEIGHT] [-o FOLDER]
Draws the scene (default outdoor-1m) along a path through its views, and writes images/, transforms.json, and points.ply, every
hundredth Gaussian's place and colour. Needs `splat` on the path (scripts/env.sh). What is in FOLDER (default
build/benchmark-set/NAME-capture) is not drawn again.
"""

import argparse
import hashlib
import json
import os
import subprocess

import command_line
import scenes

PICTURES, SIZE = 12, "980x545"
POINTS_ONE_IN = 100
SH_C0 = 0.28209479177387814


def transforms(cameras):
    """Of nerfstudio's format: camera to world, x right, y up, z back."""
    frames = []
    for camera in cameras:
        rows = [[row[0], -row[1], -row[2], at] for row, at in zip(camera["rotation"], camera["position"])]
        frames.append({"file_path": f"images/{camera['img_name']}.png", "transform_matrix": [*rows, [0, 0, 0, 1]]})
    first = cameras[0]
    return {"fl_x": first["fx"], "fl_y": first["fy"], "cx": first["width"] / 2, "cy": first["height"] / 2, "w": first["width"],
            "h": first["height"], "ply_file_path": "points.ply", "frames": frames}


def points(scene):
    """Lines of a PLY with places and colours of some of a scene's Gaussians, as `splat demo-scene` writes it."""
    with open(scene, "rb") as file:
        head, data = file.read().split(b"end_header\n", 1)
    names = [line.split()[-1].decode() for line in head.splitlines() if line.startswith(b"property float")]
    values = memoryview(data).cast("f")
    columns = [names.index(name) for name in ("x", "y", "z", "f_dc_0", "f_dc_1", "f_dc_2")]
    lines = []
    for at in range(0, len(values), POINTS_ONE_IN * len(names)):
        *place, red, green, blue = (values[at + column] for column in columns)
        colour = (round(255 * min(max(0.5 + SH_C0 * value, 0), 1)) for value in (red, green, blue))
        lines.append(" ".join([*(f"{x:.6f}" for x in place), *map(str, colour)]))
    return ["ply", "format ascii 1.0", f"element vertex {len(lines)}", *(f"property float {axis}" for axis in "xyz"),
            *(f"property uchar {name}" for name in ("red", "green", "blue")), "end_header", *lines, ""]


def folder_of(name):
    """Where a scene's capture is by default, as seen from scenes.ROOT."""
    return os.path.join(scenes.GENERATED, name + "-capture")


def captured(name, pictures=PICTURES, size=SIZE, folder=None):
    """Writes the capture unless the same is there; returns its folder, as seen from scenes.ROOT if that is the default."""
    folder = folder or folder_of(name)
    at = os.path.join(scenes.ROOT, folder)
    scene = scenes.generated(name)
    with open(os.path.join(scenes.ROOT, scene.path), "rb") as file:
        wanted = f"{hashlib.file_digest(file, 'sha256').hexdigest()} {pictures} {size}"
    done = os.path.join(at, "made-of")
    if os.path.exists(done):
        with open(done, encoding="utf-8") as file:
            if file.read() == wanted:
                return folder
    os.makedirs(os.path.join(at, "images"), exist_ok=True)
    cameras = os.path.join(at, "cameras.json")
    subprocess.run(["splat", "render", scene.path, "--cameras", scene.cameras, "--frames", str(pictures), "--size", size, "--write-cameras",
                    cameras, "-o", os.path.join(at, "images", "view.png")], check=True, cwd=scenes.ROOT)
    with open(cameras, encoding="utf-8") as file:
        views = json.load(file)
    for view in views:
        view["img_name"] = "view." + view["img_name"]
    with open(os.path.join(at, "points.ply"), "w", encoding="utf-8") as file:
        file.write("\n".join(points(os.path.join(scenes.ROOT, scene.path))))
    with open(os.path.join(at, "transforms.json"), "w", encoding="utf-8") as file:
        json.dump(transforms(views), file, indent=1)
    with open(done, "w", encoding="utf-8") as file:
        file.write(wanted)
    return folder


def main():
    parser = argparse.ArgumentParser(description="A capture of a scene of the benchmark set")
    parser.add_argument("--scene", choices=scenes.PUBLIC, default="outdoor-1m", metavar="NAME")
    parser.add_argument("--pictures", type=int, default=PICTURES, metavar="N", help=f"default {PICTURES}")
    parser.add_argument("--size", default=SIZE, metavar="WIDTHxHEIGHT", help=f"default {SIZE}")
    parser.add_argument("-o", "--out", metavar="FOLDER")
    args = parser.parse_args()
    print(captured(args.scene, args.pictures, args.size, args.out and os.path.abspath(args.out)))


if __name__ == "__main__":
    command_line.run(main)
