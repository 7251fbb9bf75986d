#!/usr/bin/env python3
"""Writes a small scene and its camera.

usage: scene.py one|random|degenerate|dc|front|late|crossing|around|strewn SCENE.ply CAMERAS.json
one: a round Gaussian in the middle of 64x48 pixels
random: 600 Gaussians of all shapes and SH degree 3, 150x100 pixels (partial
    tiles on both paths), some behind the camera, at its plane and huge
degenerate: what must not draw or fail: zero quaternion, zero and infinite
    extent, opacity 0 and 1, at the camera, far outside
dc: 40 Gaussians without the higher bands
front: a bare scene, that calls for no effect: degree 3, but zeros and -0; all
    in view, in front of the camera, of middling opacity
late: random, with the higher bands' coefficients zero (some of them -0) but
    the last one of the last Gaussian
crossing: three sheets that cross in the middle of 80x60 pixels
around: 300 clusters of 16 on all sides of the camera, many across a border of
    150x100 pixels or the near plane, with Gaussians of all sizes
strewn: the same, in no order of place
"""

import json
import math
import random
import struct
import sys


def gaussian(mean, scales, quat=(1, 0, 0, 0), opacity=0.8, sh=(0, 0, 0)):
    logit = math.log(opacity / (1 - opacity)) if 0 < opacity < 1 else (100 if opacity else -100)
    return mean, [math.log(s) if s > 0 else -100 for s in scales], quat, logit, list(sh)


def one():
    return 0, [gaussian((0, 0, 2), (0.1, 0.1, 0.1), opacity=0.5, sh=(1, 0.5, -0.5))], camera(64, 48, 50)


def rand(count=600, degree=3, width=150, height=100):
    r = random.Random(11)
    terms = 3 * (degree + 1) ** 2
    out = []
    for i in range(count):
        mean = [r.uniform(-1.6, 1.6), r.uniform(-1.2, 1.2), r.uniform(-0.5, 4)]
        if i % 50 == 0:
            mean[2] = r.uniform(0.15, 0.3)  # around the near plane
        scales = [math.exp(r.uniform(-5, -1)) for _ in range(3)]
        if i % 40 == 0:
            scales[0] = 3  # a needle or sheet across the picture
        quat = [r.gauss(0, 1) for _ in range(4)]
        sh = [r.gauss(0, 0.8) for _ in range(3)] + [r.gauss(0, 0.25) for _ in range(terms - 3)]
        out.append(gaussian(mean, scales, quat, 0.999 if i % 3 == 0 else r.uniform(0.002, 0.9), sh))
    return degree, out, camera(width, height, 110)


def degenerate():
    s = (0.1, 0.1, 0.1)
    out = [
        gaussian((0, 0, 2), s, quat=(0, 0, 0, 0)),
        gaussian((0.2, 0, 2), (0, 0, 0)),
        gaussian((-0.2, 0, 2), (1e30, 1e30, 1e30)),
        gaussian((0, 0.2, 2), s, opacity=0),
        gaussian((0, -0.2, 2), s, opacity=1),
        gaussian((0, 0, 0), s),
        gaussian((1e20, 1e20, 2), s),
        gaussian((0, 0, 0.2), s),
        gaussian((0.1, 0.1, 2), (5, 1e-9, 1e-9), quat=(0.9, 0.1, 0.3, -0.2)),
    ]
    return 0, out, camera(64, 48, 50)


def bare():
    degree, out, view = rand(200)
    for mean, _, _, _, sh in out:
        mean[0], mean[1], mean[2] = 0.3 * mean[0], 0.3 * mean[1], 2 + abs(mean[2])
        sh[3:] = [-0.0 if i % 2 else 0.0 for i in range(len(sh) - 3)]
    return degree, [(m, s, q, min(max(logit, -4), 4), sh) for m, s, q, logit, sh in out], view


def late():
    degree, out, view = rand()
    for *_, sh in out:
        sh[3:] = [-0.0 if i % 2 else 0.0 for i in range(len(sh) - 3)]
    mean, scales, quat, _, sh = out[-1]
    sh[-3:] = [2, 2, 2]
    out[-1] = ([0.2, 0.1, 1], [math.log(0.2)] * 3, quat, 4, sh)
    return degree, out, view


def crossing():
    sheets = []
    for i, turn in enumerate((-0.6, 0.2, 0.7)):  # about y; their centres are close
        colour = [1.5 if c == i else -1.5 for c in range(3)]
        quat = (math.cos(turn / 2), 0, math.sin(turn / 2), 0)
        sheets.append(gaussian((0, 0, 3 + 0.01 * i), (0.8, 0.8, 0.01), quat, 0.9, colour))
    return 0, sheets, camera(80, 60, 70)


def around():
    r = random.Random(5)
    out = []
    for i in range(300):
        # By place on the picture and beside it, so that borders have many.
        depth = math.exp(r.uniform(-2, 3)) * (-1 if i % 7 == 0 else 1)
        centre = [depth * r.uniform(-2, 2), depth * r.uniform(-2, 2), depth]
        wide, deviation = math.exp(r.uniform(-5, 0)), math.exp(r.uniform(-7, -1))
        for _ in range(16):
            mean = [c + abs(depth) * wide * r.uniform(-1, 1) for c in centre]
            scales = [abs(depth) * deviation * math.exp(r.uniform(-2, 0)) for _ in range(3)]
            out.append(gaussian(mean, scales, [r.gauss(0, 1) for _ in range(4)], r.uniform(0.01, 0.999),
                                [r.gauss(0, 0.8) for _ in range(3)]))
    return 0, out[:-5], camera(150, 100, 110)  # the last block is not full


def strewn():
    degree, out, view = around()
    random.Random(6).shuffle(out)
    return degree, out, view


def camera(width, height, focal):
    return {"id": 0, "img_name": "front", "width": width, "height": height, "position": [0, 0, 0],
            "rotation": [[1, 0, 0], [0, 1, 0], [0, 0, 1]], "fx": focal, "fy": focal}


def write(path, degree, gaussians):
    rest = (degree + 1) ** 2 - 1
    names = ["x", "y", "z", "nx", "ny", "nz", "f_dc_0", "f_dc_1", "f_dc_2"]
    names += [f"f_rest_{i}" for i in range(3 * rest)]
    names += ["opacity", "scale_0", "scale_1", "scale_2", "rot_0", "rot_1", "rot_2", "rot_3"]
    with open(path, "wb") as f:
        f.write(b"ply\nformat binary_little_endian 1.0\n")
        f.write(f"element vertex {len(gaussians)}\n".encode())
        f.write("".join(f"property float {n}\n" for n in names).encode() + b"end_header\n")
        for mean, scales, quat, logit, sh in gaussians:
            # The file has the higher bands channel by channel.
            higher = [sh[3 * (k + 1) + c] for c in range(3) for k in range(rest)]
            row = [*mean, 0, 0, 0, *sh[:3], *higher, logit, *scales, *quat]
            f.write(struct.pack(f"<{len(row)}f", *row))


kinds = {"one": one, "random": rand, "degenerate": degenerate, "dc": lambda: rand(40, 0, 64, 48),
         "front": bare, "late": late, "crossing": crossing, "around": around, "strewn": strewn}
degree, gaussians, view = kinds[sys.argv[1]]()
write(sys.argv[2], degree, gaussians)
with open(sys.argv[3], "w") as f:
    json.dump([view], f)
