"""Meshes of triangles beside Gaussians."""

from __future__ import annotations

import os

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _machine
from ._machine import UsageError
from ._words import path_bytes

_ALPHAS = ("opaque", "mask", "blend")


def _floats(name, values, *shapes):
    """`values` in float32, in one of the shapes."""
    try:
        with np.errstate(over="ignore"):
            array = np.asarray(values, dtype=np.float32)
    except (TypeError, ValueError):
        raise UsageError(f"{name}: expected an array of numbers") from None
    if array.shape not in shapes:
        raise UsageError(f"{name} has the shape {array.shape}, expected {' or '.join(map(str, shapes))}")
    if not np.isfinite(array).all():
        raise UsageError(f"{name} has a NaN or an infinity, expected finite values")
    return array


def _count(name, values, width):
    shape = np.shape(values)
    if len(shape) != 2 or shape[1] != width or shape[0] == 0:
        raise UsageError(f"{name} has the shape {shape}, expected (N, {width}) with N of at least 1")
    return shape[0]


def _corners(name, values, width, vertices, triangles):
    """For each corner of a triangle; those of vertices are spread."""
    if values is None:
        return None
    array = _floats(name, values, (vertices, width), (len(triangles), 3, width))
    return array[triangles] if array.ndim == 2 else array


class Mesh:
    """Triangles that are drawn with Gaussians (docs/meshes.md). It does not change."""

    def __init__(self, vertices: ArrayLike, triangles: ArrayLike, colors: ArrayLike | None = None, *,
                 normals: ArrayLike | None = None, uv: ArrayLike | None = None, texture: ArrayLike | None = None,
                 alpha: str = "opaque", alpha_cutoff: float = 0.5):
        """A mesh of copies of arrays.

        vertices: (N, 3), world units
        triangles: (M, 3), numbers of vertices from 0
        colors: (N, 3) or (N, 4), red, green, blue and alpha, 0 to 1, as pictures show them; None for white
        normals: (N, 3), or (M, 3, 3) of corners, of any length; None for those of the triangles
        uv: (N, 2), or (M, 3, 2) of corners: across and down the texture, 0 to 1 in it
        texture: (H, W, 3) or (H, W, 4) bytes (uint8), sRGB, rows from the top; it repeats, and is filtered linearly
        alpha: what alpha is for: "opaque" (nothing), "mask" or "blend"
        alpha_cutoff: with "mask", what is below it is not drawn
        """
        count = _count("vertices", vertices, 3)
        self._check_triangles(triangles, count)
        corners = np.asarray(triangles, dtype=np.uint32)
        if alpha not in _ALPHAS:
            raise UsageError(f"alpha={alpha!r}: expected one of {', '.join(_ALPHAS)}")
        rgba = np.ones((count, 4), dtype=np.float32)
        if colors is not None:
            given = _floats("colors", colors, (count, 3), (count, 4))
            if given.min() < 0 or given.max() > 1:
                raise UsageError("colors: expected numbers from 0 to 1")
            rgba[:, :given.shape[1]] = given
        if alpha == "opaque":
            rgba[:, 3] = 1
        if (uv is None) != (texture is None):
            raise UsageError("uv and texture: expected both or none")
        self._native = _machine.Mesh.made(
            _floats("vertices", vertices, (count, 3)), rgba, corners,
            _corners("normals", normals, 3, count, corners), _corners("uv", uv, 2, count, corners),
            None if texture is None else self._texels(texture), _ALPHAS.index(alpha),
            float(_floats("alpha_cutoff", alpha_cutoff, ())))

    @staticmethod
    def _check_triangles(triangles, vertices):
        _count("triangles", triangles, 3)
        array = np.asarray(triangles)
        if array.dtype.kind not in "iu":
            raise UsageError(f"triangles are of type {array.dtype}, expected whole numbers")
        wrong = array[(array < 0) | (array >= vertices)]
        if wrong.size:
            raise UsageError(f"triangles name vertex {wrong[0]}, expected 0 to {vertices - 1}")

    @staticmethod
    def _texels(texture):
        array = np.asarray(texture)
        if array.ndim != 3 or array.shape[2] not in (3, 4) or array.dtype != np.uint8 or array.size == 0:
            raise UsageError(f"texture has the shape {array.shape} and type {array.dtype}, expected (H, W, 3) or (H, W, 4) "
                             "of uint8")
        texels = np.full((*array.shape[:2], 4), 255, dtype=np.uint8)
        texels[..., :array.shape[2]] = array
        return texels

    @classmethod
    def read(cls, path: str | os.PathLike) -> Mesh:
        """The mesh of an OBJ, PLY or glTF file, as `splat render --mesh` reads it."""
        mesh = cls.__new__(cls)
        mesh._native = _machine.Mesh.read(path_bytes(path))
        return mesh

    def __len__(self) -> int:
        return self._native.size

    def __repr__(self) -> str:
        return f"<vorion.Mesh of {len(self)} triangles>"

    @property
    def vertices(self) -> NDArray[np.float32]:
        """(N, 3): a copy, world units."""
        return self._native.vertices

    @property
    def triangles(self) -> NDArray[np.int32]:
        """(M, 3): a copy, numbers of vertices."""
        return self._native.triangles

    @property
    def colors(self) -> NDArray[np.float32]:
        """(N, 4): a copy, red, green, blue and alpha."""
        return self._native.colors
