"""Pinhole cameras."""

from __future__ import annotations

import operator
import os

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _machine
from ._machine import UsageError
from ._words import path_bytes


def _matrix(name, values, size):
    matrix = np.asarray(values, dtype=np.float64)
    if matrix.shape != (size, size):
        raise UsageError(f"{name} has the shape {matrix.shape}, expected ({size}, {size})")
    return matrix


class Camera:
    """A pinhole camera: x right, y down, z forward. Pixel (i, j) covers [i, i+1) x [j, j+1)."""

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

    def __repr__(self) -> str:
        return f"<vorion.Camera {self.name!r}, {self.width}x{self.height}>"

    @property
    def name(self) -> str:
        """Of the view."""
        return self._native.name

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


def read_cameras(path: str | os.PathLike) -> list[Camera]:
    """All views of INRIA's cameras.json, in the order of the file."""
    return [Camera._of(native) for native in _machine.Camera.read_all(path_bytes(path))]
