#!/usr/bin/env python3
"""How far the depth order of a picture is from that of the next one, where the camera turns in between.

usage: order_between_frames.py [--scenes NAME...] [--turns DEGREES...] [--block PAIRS]

The camera turns about its own vertical axis. Where it moves without turning, all depths change by the same, and the order
stays. The Gaussians in front of both cameras are taken in the order of the first, with depths of the second. Prints how many
of them have another place then, how far these are apart, and how many passes over all of them sort them if a pass sorts blocks
of so many pairs in local memory, every second pass half a block further on.
"""

import argparse
import os
import subprocess
import tempfile

import command_line
import numpy
import scenes
import timed_frame
from dealing import turned

NEAR = 0.2


def means_of(scene, folder):
    """The means of a scene's Gaussians, a row each."""
    ply = os.path.join(folder, scene.name + ".ply")
    subprocess.run(["splat", "convert", scene.path, "-o", ply], check=True, stdout=subprocess.DEVNULL, cwd=scenes.ROOT)
    with open(ply, "rb") as f:
        names, count = [], 0
        for line in iter(f.readline, b"end_header\n"):
            words = line.split()
            if words[:2] == [b"element", b"vertex"]:
                count = int(words[2])
            elif words[0] == b"property":
                names.append(words[2].decode())
        rows = numpy.fromfile(f, dtype="<f4", count=count * len(names)).reshape(count, len(names))
    return rows[:, [names.index(axis) for axis in "xyz"]].astype(numpy.float64)


def depths(means, camera):
    forward = numpy.array([row[2] for row in camera["rotation"]])
    return ((means - numpy.array(camera["position"])) @ forward).astype(numpy.float32)


def passes_of(keys, block):
    """How many passes sort the keys, by blocks in turn from 0 and from half a block on."""
    keys, passes = keys.copy(), 0
    while (keys[1:] < keys[:-1]).any():
        begin = passes % 2 * (block // 2)
        whole = begin + (len(keys) - begin) // block * block
        keys[:begin].sort()
        keys[begin:whole].reshape(-1, block).sort(axis=1)
        keys[whole:].sort()
        passes += 1
    return passes


def row(name, turn, before, after, block):
    kept = (before > NEAR) & (after > NEAR)
    keys = after[kept][numpy.argsort(before[kept], kind="stable")]
    places = numpy.empty(len(keys), dtype=numpy.int64)
    places[numpy.argsort(keys, kind="stable")] = numpy.arange(len(keys))
    away = numpy.abs(places - numpy.arange(len(keys)))
    print(f"| {name} | {turn:g} | {len(keys):,} | {100 * (away > 0).mean():.1f} % | {away.mean():,.0f} "
          f"| {numpy.quantile(away, 0.99):,.0f} | {away.max():,} | {passes_of(keys, block)} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scenes", nargs="+", default=["guitar", "truck", "garden_outdoor"], choices=scenes.known() or None)
    parser.add_argument("--turns", nargs="+", type=float, default=[0.1, 1])
    parser.add_argument("--block", type=int, default=1024)
    args = parser.parse_args()
    print("| view | turned, degrees | in front | at another place | places, mean | 99 % | most | passes |\n|---|--:|" + "--:|" * 6)
    with tempfile.TemporaryDirectory() as folder:
        for scene in map(scenes.shared, args.scenes):
            means = means_of(scene, folder)
            for camera in timed_frame.cameras_of(os.path.join(scenes.ROOT, scene.cameras)):
                before = depths(means, camera)
                for turn in args.turns:
                    row(f"{scene.name} {camera['img_name']}", turn, before, depths(means, turned(camera, turn)), args.block)


if __name__ == "__main__":
    command_line.run(main)
