"""Cameras."""

from __future__ import annotations

import operator
import os
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _machine
from ._machine import UsageError
from ._words import path_bytes, words

if TYPE_CHECKING:
    from .scene import Scene


def _matrix(name, values, size):
    matrix = np.asarray(values, dtype=np.float64)
    if matrix.shape != (size, size):
        raise UsageError(f"{name} has the shape {matrix.shape}, expected ({size}, {size})")
    return matrix


class Camera:
    """A camera: x right, y down, z forward. Pixel (i, j) covers [i, i+1) x [j, j+1).

    One of matrices is a pinhole; read_cameras() and cameras() give cameras of all models (docs/cameras.md).
    """

    def __init__(self, width: int, height: int, intrinsics: ArrayLike, world_to_camera: ArrayLike | None = None, *,
                 name: str = "view"):
        """A camera of matrices, as gsplat.rasterization takes them.

        width, height: of the picture, pixels, 1 to 16384
        intrinsics: (3, 3), pixels: [[fx, 0, cx], [0, fy, cy], [0, 0, 1]]
        world_to_camera: (4, 4), a rotation with a translation; None for a camera in the origin that looks along +z
        name: of the view in reports
        """
        k = _matrix("intrinsics", intrinsics, 3)
        m = _matrix("world_to_camera", np.eye(4) if world_to_camera is None else world_to_camera, 4)
        if k[0, 1] != 0 or k[1, 0] != 0 or np.any(k[2] != (0, 0, 1)):
            raise UsageError("intrinsics: expected [[fx, 0, cx], [0, fy, cy], [0, 0, 1]]")
        if np.any(m[3] != (0, 0, 0, 1)):
            raise UsageError("world_to_camera: expected 0, 0, 0, 1 in the last row")
        rotation = m[:3, :3].T
        try:
            width, height = operator.index(width), operator.index(height)
        except TypeError:
            raise UsageError(f"a picture of {width}x{height} pixels, expected whole numbers") from None
        self._native = _machine.Camera(name, width, height, [k[0, 0], k[1, 1], k[0, 2], k[1, 2]], rotation.tolist(),
                                       (-rotation @ m[:3, 3]).tolist())

    @classmethod
    def _of(cls, native):
        camera = cls.__new__(cls)
        camera._native = native
        return camera

    @classmethod
    def read(cls, path: str | os.PathLike, view: str | int) -> Camera:
        """The view of INRIA's cameras.json whose img_name is `view`, or else whose id is that number."""
        return cls._of(_machine.Camera.read(path_bytes(path), str(view)))

    @classmethod
    def found(cls, scene: Scene, width: int = 640, height: int = 360) -> Camera:
        """The automatic view of a scene, that of splat render without --cameras (docs/captures.md)."""
        return cls._of(_machine.Camera.found(scene._native, width, height))

    def __repr__(self) -> str:
        return f"<vorion.Camera {self.name!r}, {self.width}x{self.height}>"

    @property
    def name(self) -> str:
        """Of the view."""
        return self._native.name

    @property
    def model(self) -> str:
        """Of the lens, as COLMAP names it: "PINHOLE", "OPENCV_FISHEYE" and so on (docs/cameras.md)."""
        return self._native.model

    @property
    def width(self) -> int:
        """Of the picture, pixels."""
        return self._native.width

    @property
    def height(self) -> int:
        """Of the picture, pixels."""
        return self._native.height

    @property
    def intrinsics(self) -> NDArray[np.float64]:
        """(3, 3), pixels."""
        fx, fy, cx, cy = self._native.intrinsics
        return np.array([[fx, 0, cx], [0, fy, cy], [0, 0, 1]])

    @property
    def world_to_camera(self) -> NDArray[np.float64]:
        """(4, 4): camera coordinates of world coordinates."""
        matrix = np.eye(4)
        matrix[:3, :3] = np.array(self._native.rotation).T
        matrix[:3, 3] = -matrix[:3, :3] @ np.array(self._native.position)
        return matrix


def cameras(scene: Scene, path: str | os.PathLike | None = None, *, view: str | list[str] | None = None,
            distorted: bool = False, size: str | None = None, orbit: int | None = None, frames: int | None = None,
            up: str | None = None) -> list[Camera]:
    """The cameras that `splat render` chooses with its options of these names.

    path: --cameras, a file or a folder of any kind that splat reads; None for the automatic view
    view: names of views, or "all"; None for the first, or all of a motion
    distorted: of a capture, the lenses of its photographs
    size: "WIDTHxHEIGHT" or "WIDTH", at the cameras' horizontal field of view
    orbit, frames: so many views around the scene, or along a path through the views
    up: "x", "-x", "y", "-y", "z" or "-z", for an orbit and an automatic view
    """
    asked = words({"distorted": distorted or None, "size": size, "orbit": orbit, "frames": frames, "up": up})
    if path is not None:
        asked += ["--cameras", os.fsdecode(path_bytes(path))]
    for name in [view] if isinstance(view, str) else view or []:
        asked += ["--view", name]
    return [Camera._of(native) for native in _machine.cameras(scene._native, asked)]


def write_cameras(path: str | os.PathLike, views: list[Camera]) -> None:
    """Writes a cameras.json from which read_cameras() reads the same numbers."""
    _machine.write_cameras(path_bytes(path), [camera._native for camera in views])


def read_cameras(path: str | os.PathLike) -> list[Camera]:
    """All views of INRIA's cameras.json, in the order of the file."""
    return [Camera._of(native) for native in _machine.Camera.read_all(path_bytes(path))]
