"""The scenes that measurements go through, with their views: those of the benchmark set (docs/tables/benchmark-set.md), which are
generated, and those beside the repository."""

import filecmp
import functools
import glob
import json
import math
import os
import subprocess
import tempfile
from dataclasses import dataclass

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
# As seen from ROOT, where programs run, so that results name no folder of one machine.
SHARED = os.path.join("..", "shared", "data", "scenes")
# Where the benchmark set is written, its kinds, and its sizes.
GENERATED = os.path.join("build", "benchmark-set")
KINDS = ("indoor", "outdoor", "object")
SIZES = {"10k": 10_000, "100k": 100_000, "1m": 1_000_000}
PUBLIC = tuple(f"{kind}-{size}" for size in SIZES for kind in KINDS)


@dataclass(frozen=True)
class Scene:
    """A scene file and its cameras; paths are absolute or as seen from ROOT."""
    name: str
    path: str
    cameras: str
    views: tuple


def views_of(cameras):
    with open(os.path.join(ROOT, cameras), encoding="utf-8") as f:
        return tuple(camera["img_name"] for camera in json.load(f))


def known():
    """Names of the scenes beside the repository; none where there is no ../shared/data."""
    folder = os.path.join(ROOT, SHARED, "cameras", "*.json")
    return sorted(os.path.splitext(os.path.basename(f))[0] for f in glob.glob(folder))


def shared(name):
    """One of known()."""
    path = sorted(glob.glob(os.path.join(ROOT, SHARED, name + ".*")))[0]
    cameras = os.path.join(SHARED, "cameras", name + ".json")
    return Scene(name, os.path.join(SHARED, os.path.basename(path)), cameras, views_of(cameras))


@functools.cache
def written(kind, gaussians, name):
    """A scene of the benchmark set with any number of Gaussians, regenerated. Files that do not change keep their dates."""
    folder = os.path.join(ROOT, GENERATED)
    os.makedirs(folder, exist_ok=True)
    scene, cameras = (os.path.join(folder, name + ending) for ending in (".ply", ".json"))
    # In a folder of this process, since several may generate the same scene.
    with tempfile.TemporaryDirectory(dir=folder) as own:
        made = {file: os.path.join(own, os.path.basename(file)) for file in (scene, cameras)}
        subprocess.run(["splat", "demo-scene", "--benchmark", kind, "--gaussians", str(gaussians), "-o", made[scene],
                        "--cameras", made[cameras]], check=True, stdout=subprocess.DEVNULL)
        for old, new in made.items():
            if not os.path.exists(old) or not filecmp.cmp(old, new, shallow=False):
                os.replace(new, old)
    return Scene(name, os.path.relpath(scene, ROOT), os.path.relpath(cameras, ROOT), views_of(cameras))


def generated(name):
    """One of PUBLIC."""
    kind, size = name.rsplit("-", 1)
    return written(kind, SIZES[size], name)


def named(name):
    """One of PUBLIC or of known()."""
    return generated(name) if name in PUBLIC else shared(name)


def at_width(scene, width, folder):
    """The same with pictures of another width, of the same shape up to the next multiple of 32 pixels; its cameras are
    written into the folder."""
    with open(os.path.join(ROOT, scene.cameras), encoding="utf-8") as f:
        cameras = json.load(f)
    for camera in cameras:
        scale = width / camera["width"]
        height = math.ceil(camera["height"] * scale / 32) * 32
        focal = {key: camera[key] * scale for key in ("fx", "fy")}
        centre = {key: camera[key] * scale for key in ("cx", "cy") if key in camera}
        camera.update(width=width, height=height, **focal, **centre)
    os.makedirs(folder, exist_ok=True)
    file = os.path.join(folder, f"{scene.name}-{width}.json")
    with open(file, "w", encoding="utf-8") as f:
        json.dump(cameras, f)
    name = f"{scene.name}-{cameras[0]['width']}x{cameras[0]['height']}"
    return Scene(name, scene.path, os.path.relpath(file, ROOT), scene.views)


def size(scene):
    """Bytes of a scene's file, or of all files of its folder."""
    path = os.path.join(ROOT, scene.path)
    if os.path.isfile(path):
        return os.path.getsize(path)
    return sum(os.path.getsize(os.path.join(folder, f)) for folder, _, files in os.walk(path) for f in files)


def with_views(path, cameras, views):
    """Any other scene, called as its file is, with these views; nothing is read."""
    path, cameras = os.path.abspath(path), os.path.abspath(cameras)
    return Scene(os.path.basename(path).split(".")[0], path, cameras, views)


def given(path, cameras):
    """The same with all views."""
    return with_views(path, cameras, views_of(os.path.abspath(cameras)))
