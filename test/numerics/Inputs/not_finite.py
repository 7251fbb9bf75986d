#!/usr/bin/env python3
"""Runs splat on what is no number, or too much, and prints how it ends.

usage: not_finite.py FOLDER
Every parameter of a Gaussian, every number of a camera, and the options that take numbers; a scene without a Gaussian;
pictures whose (tile, Gaussian) pairs are beyond memory and beyond 32 bits.
"""

import json
import os
import struct
import subprocess
import sys

NAMES = "x y z nx ny nz f_dc_0 f_dc_1 f_dc_2 opacity scale_0 scale_1 scale_2 rot_0 rot_1 rot_2 rot_3".split()
PLAIN = dict.fromkeys(NAMES, 0.0) | {"z": 2.0, "rot_0": 1.0, "scale_0": -2.0, "scale_1": -2.0, "scale_2": -2.0}
VIEW = {"id": 0, "img_name": "v", "width": 64, "height": 48, "position": [0, 0, 0],
        "rotation": [[1, 0, 0], [0, 1, 0], [0, 0, 1]], "fx": 50, "fy": 50}
folder = sys.argv[1]


def scene(*gaussians):
    with open(f"{folder}/s.ply", "wb") as f:
        f.write(b"ply\nformat binary_little_endian 1.0\n" + f"element vertex {len(gaussians)}\n".encode())
        f.write("".join(f"property float {n}\n" for n in NAMES).encode() + b"end_header\n")
        for g in gaussians:
            f.write(struct.pack(f"<{len(NAMES)}f", *(g[n] for n in NAMES)))


def camera(**changes):
    with open(f"{folder}/c.json", "w") as f:
        json.dump([VIEW | changes], f)


def attempt(what, *options):
    out = f"{folder}/p.npz"
    if os.path.exists(out):
        os.remove(out)
    done = subprocess.run(["splat", "render", f"{folder}/s.ply", "--cameras", f"{folder}/c.json", "--view", "v", "-o", out,
                           *options], capture_output=True, text=True)
    lines = done.stderr.strip().splitlines()
    said = lines[0].replace(folder, "") if len(lines) == 1 else f"{len(lines)} lines"
    print(f"{what}: {done.returncode}: {said}{', and a picture' if os.path.exists(out) else ''}")


camera()
for name in ("x", "f_dc_1", "opacity", "scale_2", "rot_3"):
    for value in ("nan", "inf", "-inf"):
        scene(PLAIN, PLAIN | {name: float(value)})
        attempt(f"{name} {value}")
scene()
attempt("no Gaussian")
scene(PLAIN)
for key, value in (("fx", float("nan")), ("fy", 0), ("fx", -50), ("width", 0), ("height", 100000),
                   ("position", [0, float("inf"), 0]), ("rotation", [[0, 0, 0]] * 3)):
    camera(**{key: value})
    attempt(f"camera {key} {value}")
camera()
for option in ("--cutoff", "--dilation", "--background"):
    for value in ("nan", "inf", "-inf"):
        attempt(f"{option} {value}", f"{option}={value}{',0,0' if option == '--background' else ''}")
camera(width=16384, height=16384)
for count in (1000, 5000):
    scene(*[PLAIN | {"scale_0": 5.0, "scale_1": 5.0, "scale_2": 5.0}] * count)
    attempt(f"{count} over 2^20 tiles", "--path", "simt")
