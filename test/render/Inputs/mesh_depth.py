#!/usr/bin/env python3
"""Compares the depths of a picture with a mesh with those without it and with the mesh's own.

usage: mesh_depth.py WITH.npz WITHOUT.npz VISIBLE.npz
"""

import array
import sys
import zipfile


def values(path, name, kind="f"):
    data = zipfile.ZipFile(path).read(name + ".npy")
    return array.array(kind, data[10 + int.from_bytes(data[8:10], "little"):])


both, alone, seen = sys.argv[1:]
pixels = zip(values(both, "depth"), values(both, "alpha"), values(alone, "depth"), values(alone, "alpha"),
             values(seen, "depth"), values(seen, "triangle", "i"))
mesh_alone = in_front = no_mesh = wrong = 0
for depth, alpha, own_depth, own_alpha, mesh, triangle in pixels:
    if triangle < 0:
        no_mesh += 1
        wrong += (depth, alpha) != (own_depth, own_alpha)
    elif depth == mesh:
        mesh_alone += 1
        wrong += alpha != 1
    else:  # Gaussians in front of the mesh are nearer, and what is covered hides all
        in_front += 1
        wrong += alpha != 1 or not depth < mesh * (1 + 1e-5)
print(f"{mesh_alone} pixels show the mesh alone, {in_front} Gaussians in front of it, {no_mesh} no mesh; {wrong} wrong")
