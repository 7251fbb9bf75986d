#!/usr/bin/env python3
"""What the outputs beside a picture say of each other.

usage: layers.py PICTURE.npz ACCUMULATED.npz EXPECTED.npz MEDIAN.npz NORMALS.npz OPACITY.npz ALL.npz TOP.npz SCENE.ply
       CAMERAS.json
ALL has every contributor of a pixel, TOP two.
"""

import json
import sys

import numpy as np

picture, accumulated, expected, median, normals, opacity, every, top = map(np.load, sys.argv[1:9])
alpha = picture["alpha"]
shape = alpha.shape
for depth in accumulated, expected, median:
    assert depth["depth"].shape == shape and (depth["alpha"] == alpha).all()
assert (opacity["opacity"] == alpha).all()
seen = alpha > 0
assert np.allclose(expected["depth"][seen] * alpha[seen], accumulated["depth"][seen], rtol=1e-6)
assert (expected["depth"][~seen] == 0).all() and (median["depth"][~seen] == 0).all()

index, weight, count = every["index"], every["weight"], every["count"]
assert index.shape == weight.shape == (*shape, 64) and count.shape == shape
assert count.max() <= 64, f"{count.max()} contributors, too many for this test"
assert ((index >= 0).sum(axis=2) == count).all() and ((index >= 0) == (weight > 0)).all()

# Of floats alone, as splat demo-scene writes it; the first view's depths.
with open(sys.argv[9], "rb") as f:
    header, body = f.read().split(b"end_header\n", 1)
names = [line.split()[-1].decode() for line in header.splitlines() if line.startswith(b"property float ")]
scene = np.frombuffer(body, np.float32).reshape(-1, len(names)).astype(float)
with open(sys.argv[10], encoding="utf-8") as f:
    view = json.load(f)[0]
means = scene[:, [names.index(axis) for axis in "xyz"]]
depths = (means - view["position"]) @ np.array(view["rotation"])[:, 2]
assert index.max() < len(scene)
sums = (weight * depths[index]).sum(axis=2)
assert np.allclose(sums, accumulated["depth"], rtol=1e-5, atol=1e-5)
nearest = np.abs(depths[index] - median["depth"][:, :, None]).min(axis=2, where=index >= 0, initial=np.inf)
assert (nearest[seen] < 1e-5).all(), "a median depth is no contributor's"
assert (np.diff(weight, axis=2) <= 0).all(), "the largest weight is not the first"
assert np.allclose(weight.sum(axis=2), alpha, atol=2e-6)
assert (top["index"] == index[:, :, :2]).all() and (top["weight"] == weight[:, :, :2]).all()
assert (top["count"] == count).all()

# Shortest axes, as the third column or so of the rotation, towards the camera.
w, x, y, z = scene[:, [names.index(f"rot_{i}") for i in range(4)]].T / np.linalg.norm(
    scene[:, [names.index(f"rot_{i}") for i in range(4)]], axis=1)
rotation = np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])
shortest = scene[:, [names.index(f"scale_{i}") for i in range(3)]].argmin(axis=1)
turned = rotation[:, shortest, np.arange(len(scene))].T
away = (turned * (means - view["position"])).sum(axis=1) > 0
turned[away] *= -1
assert np.allclose((weight[..., None] * turned[index]).sum(axis=2), normals["normals"], atol=1e-5)
assert (normals["alpha"] == alpha).all()
print(f"{int(seen.sum())} pixels agree, of up to {int(count.max())} contributors")
