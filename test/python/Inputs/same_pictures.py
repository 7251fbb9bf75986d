#!/usr/bin/env python3
"""Compares pictures of the package with what splat wrote.

usage: same_pictures.py FOLDER, which has s.ply, c.json and the results of same-bits.test
"""

import json
import os
import sys
import threading

import numpy as np
import vorion
from bits import same, same_picture

os.chdir(sys.argv[1])
machine = vorion.Machine()
scene, camera = vorion.Scene.read("s.ply"), vorion.Camera.read("c.json", "front")

# The first clocked run of a process begins, as splat does, with empty caches.
picture = machine.render(scene, camera, depth=True, time=True)
same_picture(picture, "raster.npz")
same(picture.depth, np.load("depth.npz")["depth"], "depth")
with open("raster.json", encoding="utf-8") as f:
    wanted = json.load(f)
assert picture.counters == wanted["total"]["counters"]
assert picture.cycles == wanted["time"]["sum"]["cycles"] > 0
assert picture.milliseconds == wanted["time"]["frame_ms"]
for key in ("options", "effects", "programs", "counts", "rules", "support", "path", "resolution"):
    assert picture.report[key] == wanted[key], key
plain = machine.render(scene, camera)
same_picture(plain, "raster.npz")
assert plain.cycles is None and plain.milliseconds is None and plain.depth is None
assert machine.render(scene, camera, effects="flags").image.tobytes() == picture.image.tobytes()
same_picture(machine.render(scene, camera, path="simt", support="box3", background=(0.25, np.float32(-1), 0.5)), "simt.npz")

# What a picture has beside its colours.
layers = machine.render(scene, camera, depth=True, depth_as="expected", normals=True, contributors=4)
same_picture(layers, "raster.npz")
same(layers.depth, np.load("expected.npz")["depth"], "expected depth")
same(layers.normals, np.load("normals.npz")["normals"], "normals")
top = np.load("top.npz")
for name in ("index", "weight", "count"):
    same(getattr(layers.contributors, name), top[name], name)
median = machine.render(scene, camera, depth=True, depth_as="median")
same(median.depth, np.load("median.npz")["depth"], "median depth")
assert median.normals is None and median.contributors is None

# With a mesh of a file, and with one of arrays.
ball, light = vorion.Mesh.read("m.obj"), (0.3, -1, 0.5)
again = vorion.Mesh(ball.vertices, ball.triangles, ball.colors)
with open("mesh.json", encoding="utf-8") as f:
    wanted = json.load(f)["mesh"]
for mesh in (ball, again):
    beside = machine.render(scene, camera, mesh=mesh, light=light, depth=True)
    same_picture(beside, "mesh.npz")
    same(beside.depth, np.load("mesh-depth.npz")["depth"], "depth with a mesh")
    assert beside.report["mesh"] == {key: value for key, value in wanted.items() if key != "file"}
coarse = machine.render(scene, camera, mesh=vorion.Mesh.read("m.gltf"), path="simt", visible=True, subpixel_bits=4,
                        mesh_depth="unorm16", filter_bits=2)
same_picture(coarse, "textured.npz")
seen = np.load("visible.npz")
for name in ("depth", "triangle"):
    same(coarse.visible[name], seen[name], f"{name} of the mesh")

# A square in front of all that shows a texture, and a pane through which the rest is seen.
empty = vorion.Scene(scene.means + [0, 0, 99], scene.log_scales, scene.quats, scene.opacity_logits, scene.sh)
square, halves = [[-9, -9, 0.5], [9, -9, 0.5], [9, 9, 0.5], [-9, 9, 0.5]], [[0, 1, 2], [0, 2, 3]]
texture = 100 + 10 * np.arange(3 * 4, dtype=np.uint8).reshape(2, 2, 3)
around = 9 * 110 / 0.5 / 150  # pictures beside the middle of the square, in which the texture is once
left, right, top, bottom = 0.5 - around, 0.5 + around, 0.5 - 1.5 * around, 0.5 + 1.5 * around
uv = [[left, top], [right, top], [right, bottom], [left, bottom]]
shown = machine.render(empty, camera, mesh=vorion.Mesh(square, halves, uv=uv, texture=texture)).image
for y, x in ((0, 0), (0, 1), (1, 0), (1, 1)):
    assert np.abs(shown[25 + 50 * y, 37 + 75 * x] * 255 - texture[y, x]).max() < 3, (shown[25 + 50 * y, 37 + 75 * x] * 255, texture[y, x])
nearest = np.array(square) * 0.402  # beyond the near plane
pane = machine.render(scene, camera, mesh=vorion.Mesh(nearest, halves, [(1, 0, 0, 0.25)] * 4, alpha="blend")).image
assert np.abs(pane[50, 75] - 0.75 * plain.image[50, 75] - [0.25, 0, 0]).max() < 1e-5
corners = machine.render(scene, camera, mesh=vorion.Mesh(square, halves, normals=np.tile([0, 0, -1.0], (2, 3, 1))), light=(0, 0, 1))
same(corners.image, machine.render(scene, camera, mesh=vorion.Mesh(square, halves), light=(0, 0, 1)).image, "normals")

opacities = 1 / (1 + np.exp(-scene.opacity_logits.astype(float)))

# A scene of arrays, and one that is changed in place.
copy = vorion.Scene(scene.means, scene.log_scales, scene.quats, scene.opacity_logits, scene.sh)
assert len(copy) == 600 and copy.sh_degree == 3 and copy.means.base is not None
same_picture(machine.render(copy, camera), "raster.npz")
kept = copy.means.copy()
copy.means += 0.1
assert machine.render(copy, camera).image.tobytes() != picture.image.tobytes()
copy.means[:] = kept
same_picture(machine.render(copy, camera), "raster.npz")
means = copy.means
del copy  # the array keeps its scene
assert means.tobytes() == kept.tobytes()
plain = vorion.Scene(scene.means, scene.log_scales, scene.quats, scene.opacity_logits, scene.sh[:, :1])
colors = scene.sh[:, 0] * 0.28209479177387814 + 0.5
activated = vorion.Scene.from_activated(scene.means, scene.quats, np.exp(scene.log_scales), opacities, colors)
images = [machine.render(s, camera).image for s in (plain, activated)]
assert np.abs(images[0] - images[1]).max() < 1e-3, np.abs(images[0] - images[1]).max()
assert machine.render(vorion.Scene.read("s.ply", antialiased=True), camera).image.tobytes() != picture.image.tobytes()

# A camera of matrices.
same_picture(machine.render(scene, vorion.Camera(150, 100, camera.intrinsics, camera.world_to_camera)), "raster.npz")
turned = np.eye(4)
turned[:3, :3] = [[0, -1, 0], [1, 0, 0], [0, 0, 1]]
turned[:3, 3] = [1, 2, 3]
assert np.allclose(vorion.Camera(8, 8, camera.intrinsics, turned).world_to_camera, turned)
assert [c.name for c in vorion.read_cameras("c.json")] == ["front"]

# Other threads of Python run while the machine does: this one keeps the GIL between the two lines otherwise.
sys.setswitchinterval(1000)
go, ran = threading.Event(), []
worker = threading.Thread(target=lambda: (go.wait(), ran.append(True)))
worker.start()
go.set()
machine.render(scene, camera)
assert ran, "the GIL was not released"
worker.join()
