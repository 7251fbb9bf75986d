"""The scenes that measurements go through, with their views."""

import glob
import json
import os
from dataclasses import dataclass

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
# As seen from ROOT, where programs run, so that results name no folder of one machine.
SHARED = os.path.join("..", "shared", "data", "scenes")


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


def at_width(scene, width, folder):
    """The same with pictures of another width, of the same shape to the nearest multiple of 32 pixels; its cameras are
    written into the folder."""
    with open(os.path.join(ROOT, scene.cameras), encoding="utf-8") as f:
        cameras = json.load(f)
    for camera in cameras:
        scale = width / camera["width"]
        height = round(camera["height"] * scale / 32) * 32
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
