"""A scene in map coordinates has all its digits in Python, and is drawn as by splat render.

usage: far.py FAR.ply CAMERAS.json PICTURE.npz
"""

import sys

import numpy as np
import vorion

scene = vorion.Scene.read(sys.argv[1])
camera = vorion.read_cameras(sys.argv[2])[0]
machine = vorion.Machine()
drawn = np.load(sys.argv[3])["render"]


def same(of, what):
    picture = machine.render(of, camera).image
    print(what, np.array_equal(picture, drawn))


print(scene.means.dtype, np.abs(np.median(scene.means, axis=0) - [412345, 5654321, 120]).max() < 3)
same(scene, "read:")
try:
    scene.means += 1
except ValueError:
    print("not in place")
copy = vorion.Scene(scene.means, scene.log_scales, scene.quats, scene.opacity_logits, scene.sh)
same(copy, "made of arrays:")
copy.means = scene.means + 1
copy.means = copy.means - 1
same(copy, "assigned:")
found = np.linalg.inv(vorion.Camera.found(scene, 64, 48).world_to_camera)[:3, 3]
print("found in map coordinates:", np.abs(found - [412345, 5654321, 120]).max() < 100)
print("lost:", scene.write(sys.argv[1] + ".again.ply")["position"])
home = vorion.Scene(scene.means - [412345, 5654321, 120], scene.log_scales, scene.quats, scene.opacity_logits, scene.sh)
print("at home:", home.means.dtype)
