#!/usr/bin/env python3
"""posed.py SCRATCH: COLMAP finds the poses of pictures that splat drew, and reads and writes the models that splat reads.

The pictures are of spots of many colours on a floor and two walls. The poses are compared with the true ones, after the
similarity that maps the places of the cameras.
"""

import json
import os
import re
import sys

import numpy as np
from programs import run

scratch = sys.argv[1]
VIEWS, WIDTH, HEIGHT, FOCAL = 12, 400, 300, 380.0


def path(name):
    return os.path.join(scratch, name)


def write_scene():
    """A .splat: 32 bytes a Gaussian."""
    draw = np.random.default_rng(7)
    count = 6000
    places = draw.uniform(-2, 2, (count, 3))
    wall = draw.integers(0, 3, count)
    places[np.arange(count), wall] = 2  # x, y (down) or z
    row = np.zeros(count, [("place", "<f4", 3), ("scale", "<f4", 3), ("colour", "u1", 4), ("rotation", "u1", 4)])
    row["place"], row["scale"] = places, draw.uniform(0.01, 0.05, count)[:, None]
    row["colour"][:, :3], row["colour"][:, 3] = draw.integers(0, 256, (count, 3)), 250
    row["rotation"] = (255, 128, 128, 128)
    row.tofile(path("spots.splat"))


def write_cameras():
    """Cameras on an arc in front of the corner, which look at it; their places."""
    cameras = []
    for number in range(VIEWS):
        angle = np.radians(-20 + 70 * number / (VIEWS - 1))
        place = np.array([2 - 5 * np.sin(angle + 0.35), -0.6 + 0.05 * number, 2 - 5 * np.cos(angle + 0.35)])
        forward = np.array([0.9, 0.8, 0.9]) - place
        forward /= np.linalg.norm(forward)
        right = np.cross([0, 1, 0], forward)
        right /= np.linalg.norm(right)
        rotation = np.stack([right, np.cross(forward, right), forward], 1)
        cameras.append({"id": number, "img_name": f"v{number:02}", "width": WIDTH, "height": HEIGHT, "position": place.tolist(),
                        "rotation": rotation.tolist(), "fx": FOCAL, "fy": FOCAL})
    with open(path("cameras.json"), "w", encoding="utf-8") as file:
        json.dump(cameras, file)
    return np.array([c["position"] for c in cameras]), np.array([c["rotation"] for c in cameras])


def similarity(theirs, ours):
    """Scale, rotation and shift that map the places theirs to ours (Umeyama 1991)."""
    a, b = theirs - theirs.mean(0), ours - ours.mean(0)
    u, s, v = np.linalg.svd(b.T @ a)
    signs = np.diag([1, 1, np.sign(np.linalg.det(u @ v))])
    scale = np.sum(s * np.diag(signs)) / np.sum(a * a)
    rotation = u @ signs @ v
    return scale, rotation, ours.mean(0) - scale * rotation @ theirs.mean(0)


def main():
    os.makedirs(path("photos"), exist_ok=True)
    write_scene()
    places, rotations = write_cameras()
    run("splat", "render", path("spots.splat"), "--cameras", path("cameras.json"), "--view", "all", "-o", path("photos/p.png"))
    said = run("splat", "capture", path("photos"), "-o", path("capture"))
    registered = int(re.search(r"registered +(\d+) of", said)[1])
    if registered < VIEWS - 2 or "judgement    good" not in said:
        sys.exit(said)
    # splat's reader beside the true cameras.
    run("splat", "render", path("spots.splat"), "--cameras", path("capture"), "--view", "all", "--size", "40x30", "-o", path("x.png"), "--write-cameras",
        path("found.json"))
    with open(path("found.json"), encoding="utf-8") as file:
        found = json.load(file)
    numbers = [int(re.search(r"v(\d\d)", c["img_name"])[1]) for c in found]
    theirs = np.array([c["position"] for c in found])
    scale, turn, shift = similarity(theirs, places[numbers])
    off = np.linalg.norm(scale * theirs @ turn.T + shift - places[numbers], axis=1).max()
    cosines = [(np.trace((turn @ np.array(c["rotation"])).T @ rotations[n]) - 1) / 2 for c, n in zip(found, numbers)]
    angle = np.degrees(np.arccos(np.clip(min(cosines), -1, 1)))
    if off > 0.05 or angle > 0.5:
        sys.exit(f"poses are off by {off} and {angle} degrees, expected 0.05 of 5 units and 0.5 degrees")
    # Its converter writes what splat reads in the same way.
    os.makedirs(path("text"), exist_ok=True)
    run("colmap", "model_converter", "--input_path", path("capture/sparse/0"), "--output_path", path("text"), "--output_type", "TXT")
    run("splat", "info", path("capture"), "--json", path("binary.json"))
    run("splat", "info", path("text"), "--images", path("photos"), "--json", path("text.json"))
    kept = []
    for name in ("binary", "text"):
        with open(path(f"{name}.json"), encoding="utf-8") as file:
            report = json.load(file)
        kept.append((report["points"], [v["name"] for v in report["views"]]))
    if kept[0] != kept[1]:
        sys.exit(f"{kept[0]}, and of the text {kept[1]}")
    version = re.search(r"COLMAP ([\d.]+)", run("colmap", "help"))[1]
    print(f"peer COLMAP {version}: finds {registered} of {VIEWS} poses of splat's pictures, at most {off:.3f} units of 5 and {angle:.2f} degrees off; "
          "splat reads its models as binary and text alike")


main()
