#!/usr/bin/env python3
"""Compares gradients of the package with what splat wrote.

usage: same_gradients.py FOLDER, which has s.ply, c.json, up.npz and the results of same-bits.test
"""

import json
import os
import sys

import numpy as np
import vorion
from bits import same, same_picture

os.chdir(sys.argv[1])
machine = vorion.Machine()
scene, camera = vorion.Scene.read("s.ply"), vorion.Camera.read("c.json", "front")
up = np.load("up.npz")

# The first clocked run of a process begins, as splat does, with empty caches.
timed = machine.gradients(scene, camera, up["in_v_render"], up["in_v_alpha"], time=True)
with open("back.json", encoding="utf-8") as f:
    wanted = json.load(f)
assert timed.cycles == wanted["time"]["sum"]["cycles"] > 0
assert timed.counters == wanted["total"]["counters"]

for file, options in (("raster-back.npz", {}), ("simt-back.npz", {"path": "simt", "tile": 8, "rules": "gsplat"}),
                      ("points-back.npz", {"projection": "unscented"})):
    back = machine.gradients(scene, camera, up["in_v_render"], up["in_v_alpha"], **options)
    same_picture(back, file, "f32_")
    results = np.load(file)
    for name in ("means", "quats", "scales", "opacities", "means2d", "conics"):
        same(back.by[name], results["f32_g_" + name], f"{file} {name}")
    same(back.by["sh"], results["f32_g_colors"], file + " sh")

# In front of a wall behind all they are those of a background in its colour, which an opaque mesh is.
corners, color = np.array([[-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1]]) * 90, (0.25, 0.5, 0.75)
wall = vorion.Mesh(corners, [[0, 1, 2], [0, 2, 3]], [color] * 4)
for path in ("raster", "simt"):
    beside = machine.gradients(scene, camera, up["in_v_render"], mesh=wall, path=path)
    alone = machine.gradients(scene, camera, up["in_v_render"], background=color, path=path)
    assert np.abs(beside.image - alone.image).max() < 1e-5 and (beside.alpha == 1).all()
    for name in beside.by:
        off = np.linalg.norm(beside.by[name] - alone.by[name]) / np.linalg.norm(alone.by[name])
        assert off < 1e-3, (path, name, off)
hidden = machine.gradients(scene, camera, up["in_v_render"], mesh=vorion.Mesh(corners * 0.201 / 90, [[0, 1, 2], [0, 2, 3]])).by
assert not any(np.any(hidden[name]) for name in hidden)

# By stored parameters: the chain rule, in double.
stored = machine.gradients(scene, camera, up["in_v_render"], up["in_v_alpha"], of="stored").by
opacities = 1 / (1 + np.exp(-scene.opacity_logits.astype(float)))
for name, chained in (("log_scales", timed.by["scales"] * np.exp(scene.log_scales.astype(float))),
                      ("opacity_logits", timed.by["opacities"] * opacities * (1 - opacities)), ("means", timed.by["means"])):
    assert np.allclose(stored[name], chained, rtol=1e-4, atol=1e-6 * np.abs(chained).max()), name
assert "scales" not in stored and "opacities" not in stored
