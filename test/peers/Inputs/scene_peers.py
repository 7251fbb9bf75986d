#!/usr/bin/env python3
"""scene_peers.py PEER MODULES SCRATCH: whether an npm package and splat read each other's scenes with the same values.

PEER is splat-transform or gaussian-splats-3d; MODULES is the folder node_modules. Prints what the peer decided.
"""

import json
import os
import sys

import numpy as np
from programs import run

peer, modules, scratch = sys.argv[1:]
PACKAGE = {"splat-transform": "@playcanvas/splat-transform", "gaussian-splats-3d": "@mkkellogg/gaussian-splats-3d"}[peer]
# Readers decode a stored step in fp32 by other formulas than ours.
RELATIVE = 1e-5


def path(name):
    return os.path.join(scratch, name)


def values(ply):
    """The properties of a PLY of floats, by name."""
    with open(ply, "rb") as file:
        data = file.read()
    end = data.index(b"end_header\n") + len(b"end_header\n")
    names = [line.split()[2] for line in data[:end].decode().splitlines() if line.startswith("property float ")]
    table = np.frombuffer(data, np.float32, offset=end).reshape(-1, len(names)).astype(np.float64)
    return dict(zip(names, table.T))


def activated(ply):
    """The 14 numbers of each Gaussian that gaussian_splats_3d.mjs writes, from a PLY, but colours and alpha unrounded."""
    v = values(ply)
    quats = np.stack([v[f"rot_{i}"] for i in range(4)], 1)
    return np.concatenate([
        np.stack([v[a] for a in "xyz"], 1), np.exp(np.stack([v[f"scale_{i}"] for i in range(3)], 1)),
        quats / np.linalg.norm(quats, axis=1)[:, None],
        255 * (0.5 + 0.28209479177387814 * np.stack([v[f"f_dc_{i}"] for i in range(3)], 1)),
        255 / (1 + np.exp(-v["opacity"]))[:, None]], 1)


def same(what, ours, theirs, bound):
    """Both are arrays; quaternions have one sign."""
    worst = np.max(np.abs(ours - theirs) / (1 + np.abs(ours)))
    if ours.shape != theirs.shape or not worst <= bound:
        sys.exit(f"{what}: differs by {worst}, expected at most {bound}")


def axes(v):
    """The rotations of a PLY's Gaussians as matrices whose squares of columns, times their scales, are covariances."""
    w, x, y, z = np.stack([v[f"rot_{i}"] for i in range(4)]) / np.sqrt(sum(v[f"rot_{i}"] ** 2 for i in range(4)))
    return np.stack([np.stack(row, -1) for row in (
        (1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)),
        (2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)),
        (2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)))], 1)


def same_plys(what, ours, theirs, rotation=RELATIVE):
    a, b = values(ours), values(theirs)
    for name in b:
        if name[0] == "n" or name.startswith("rot_"):
            continue
        x, y = a[name], b[name]
        if name == "opacity":  # a byte of 0 or 255 has no logit
            x, y = 1 / (1 + np.exp(-x)), 1 / (1 + np.exp(-y))
        same(f"{what}, {name}", x, y, RELATIVE)
    # Columns have any sign.
    x, y = axes(a), axes(b)
    same(f"{what}, rotation", x, y * np.sign(np.sum(x * y, 1, keepdims=True)), rotation)


def axes_of(ending):
    """Options with which splat converts axes as splat-transform always does for files with this ending."""
    return {"spz": ("--axes", "rub:rdf"), "glb": ("--axes", "luf:rdf")}.get(ending, ())


def splat_transform():
    command = ["node", os.path.join(modules, PACKAGE, "bin", "cli.mjs"), "-q", "-w", "-g", "cpu"]
    read = written = 0
    for ending in ("ply", "compressed.ply", "splat", "spz", "sog"):
        run("splat", "convert", path("scene.ply"), "-o", path(f"ours.{ending}"))
        run(*command, path(f"ours.{ending}"), path("theirs.ply"))
        run("splat", "convert", path(f"ours.{ending}"), *axes_of(ending), "-o", path("read.ply"))
        same_plys(f"splat's .{ending}", path("read.ply"), path("theirs.ply"),
                  # A byte is (b - 128) / 128 to us and gaussian-splats-3d, (b - 127.5) / 127.5 to splat-transform.
                  0.02 if ending == "splat" else RELATIVE)
        read += 1
    for ending, options in (("ply", ()), ("compressed.ply", ()), ("spz", ()), ("spz", ("--spz-version", "3")), ("sog", ()), ("glb", ())):
        run(*command, *options, path("scene.ply"), path(f"made.{ending}"))
        run("splat", "convert", path(f"made.{ending}"), *axes_of(ending), "-o", path("read.ply"))
        if ending == "glb":  # which it writes and does not read
            run("splat", "convert", path("made.glb"), *axes_of(ending), "--morton-order", "-o", path("read.ply"))
            run("splat", "convert", path("scene.ply"), "--morton-order", "-o", path("theirs.ply"))
        else:
            run(*command, path(f"made.{ending}"), path("theirs.ply"))
        same_plys(f"its .{ending}", path("read.ply"), path("theirs.ply"))
        written += 1
    return f"reads {read} formats of splat's, and splat reads {written} of its own, with the same values"


def gaussian_splats_3d():
    script = os.path.join(os.path.dirname(__file__), "gaussian_splats_3d.mjs")
    for ending in ("ply", "compressed.ply", "splat"):
        run("splat", "convert", path("scene.ply"), "-o", path(f"ours.{ending}"))
        run("node", "--no-warnings", script, modules, "read", path(f"ours.{ending}"), path("theirs.f32"))
        run("splat", "convert", path(f"ours.{ending}"), "-o", path("read.ply"))
        ours, theirs = activated(path("read.ply")), np.fromfile(path("theirs.f32"), np.float32).astype(float).reshape(-1, 14)
        ours[:, 10:] = np.clip(ours[:, 10:], 0, 255)
        theirs[:, 6:10] *= np.sign(np.sum(ours[:, 6:10] * theirs[:, 6:10], 1))[:, None]
        same(f"splat's .{ending}", ours[:, :10], theirs[:, :10], 2e-5)
        same(f"splat's .{ending}, colours", ours[:, 10:] / 255, theirs[:, 10:] / 255, 1.01 / 255)  # which it cuts to bytes
    for level in (0, 1, 2):
        run("node", "--no-warnings", script, modules, "write", path("scene.ply"), str(level), path("made.ksplat"))
        run("splat", "convert", path("made.ksplat"), "-o", path("read.ply"))
        ours, theirs = activated(path("read.ply")), activated(path("scene.ply"))
        # Its order is another, and its positions have steps from level 1 on.
        nearest = [int(np.argmin(np.sum((theirs[:, :3] - p) ** 2, 1))) for p in ours[:, :3]]
        if len(set(nearest)) != len(theirs):
            sys.exit(f"level {level}: {len(set(nearest))} of {len(theirs)} Gaussians, expected all")
        theirs = theirs[nearest]
        theirs[:, 6:10] *= np.sign(np.sum(ours[:, 6:10] * theirs[:, 6:10], 1))[:, None]
        theirs[:, 10:] = np.clip(theirs[:, 10:], 0, 255)
        same(f"level {level}", ours[:, :10], theirs[:, :10], 1e-6 if level == 0 else 2e-3)
        same(f"level {level}, colours", ours[:, 10:] / 255, theirs[:, 10:] / 255, 1.01 / 255)
    return "reads 3 formats of splat's with the same values; splat reads its .ksplat of 3 levels"


def main():
    os.makedirs(scratch, exist_ok=True)
    run("splat", "demo-scene", "-o", path("scene.ply"), "--gaussians", "1000")
    with open(os.path.join(modules, PACKAGE, "package.json"), encoding="utf-8") as file:
        version = json.load(file)["version"]
    decided = splat_transform() if peer == "splat-transform" else gaussian_splats_3d()
    print(f"peer {peer} {version}: {decided}")


main()
