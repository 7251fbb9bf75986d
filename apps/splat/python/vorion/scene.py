"""3D Gaussian scenes."""

from __future__ import annotations

import os

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _machine
from ._machine import UsageError
from ._words import path_bytes, words

_SH_C0 = 0.28209479177387814  # Y_00: what the constant coefficient is multiplied by


def _degree(sh):
    """Of an array (N, K, 3)."""
    for degree in range(4):
        if sh.ndim == 3 and sh.shape[1:] == ((degree + 1) ** 2, 3):
            return degree
    raise UsageError(f"sh has the shape {sh.shape}, expected (N, K, 3) with K = 1, 4, 9 or 16 coefficients")


class Scene:
    """N Gaussians with the parameters that a PLY of INRIA's stores, before activation.

    Every parameter is a float32 array that shares the scene's memory: what is written into it, as by
    `scene.means -= rate * gradient`, is what is drawn next. Their number stays. Nothing may write while the machine draws
    in another thread. Means for which fp32 has too few digits, as in map coordinates, are a float64 copy that cannot be
    written: assign the property (`scene.means = scene.means - rate * gradient`).
    """

    def __init__(self, means: ArrayLike, log_scales: ArrayLike, quats: ArrayLike, opacity_logits: ArrayLike,
                 sh: ArrayLike, *, antialiased: bool = False, dilation: float | None = None):
        """A scene of copies of arrays.

        means: (N, 3), world units; more digits than float32 are kept where a picture shows them
        log_scales: (N, 3), natural logarithms of standard deviations
        quats: (N, 4), w x y z, of any length
        opacity_logits: (N,), opacity = 1 / (1 + exp(-logit))
        sh: (N, K, 3), spherical harmonics of red, green and blue; K = 1, 4, 9 or 16 for degree 0 to 3
        antialiased: compensate opacities for the dilation
        dilation: added to both variances on the picture, px^2; None for 0.3
        """
        sh = np.asarray(sh, dtype=np.float32)
        self._native = _machine.Scene.sized(sh.shape[0], _degree(sh), antialiased, dilation)
        for name, values in {"means": means, "log_scales": log_scales, "quats": quats, "opacity_logits": opacity_logits,
                             "sh": sh}.items():
            setattr(self, name, values)

    @classmethod
    def from_activated(cls, means: ArrayLike, quats: ArrayLike, scales: ArrayLike, opacities: ArrayLike,
                       colors: ArrayLike, *, antialiased: bool = False, dilation: float | None = None) -> Scene:
        """A scene of the arrays that gsplat.rasterization takes, in its order.

        scales: (N, 3), above 0, standard deviations in world units
        opacities: (N,), 0 to 1; logits are cut off at 30 either way
        colors: (N, 3), red, green and blue, or (N, K, 3), spherical harmonics
        The rest is as for Scene(...). Logarithms and logits are rounded to float32.
        """
        colors = np.asarray(colors, dtype=np.float64)
        opacities = np.asarray(opacities, dtype=np.float64)
        scales = np.asarray(scales, dtype=np.float64)
        if colors.ndim == 2:
            colors = ((colors - 0.5) / _SH_C0)[:, None, :]
        if not np.all(scales > 0):
            raise UsageError("scales: expected numbers above 0")
        if not np.all((opacities >= 0) & (opacities <= 1)):
            raise UsageError("opacities: expected numbers from 0 to 1")
        with np.errstate(divide="ignore"):
            logits = np.clip(np.log(opacities) - np.log1p(-opacities), -30, 30)
        return cls(means, np.log(scales), quats, logits, colors, antialiased=antialiased, dilation=dilation)

    @classmethod
    def read(cls, path: str | os.PathLike, *, axes: str | None = None, lod: int | None = None,
             drop_nonfinite: bool = False, antialiased: bool | None = None, dilation: float | None = None) -> Scene:
        """The scene of a file of any format that splat reads (docs/scenes.md).

        axes: mirror between conventions, as "rub:rdf"
        lod: level of detail of a streamed scene, 0 for the finest
        drop_nonfinite: leave out Gaussians with a NaN or an infinity, where they are an InputError else
        antialiased, dilation: as for Scene(...); None for what the file says
        """
        asked = words({"axes": axes, "lod": lod, "drop_nonfinite": drop_nonfinite or None, "dilation": dilation})
        if antialiased is not None:
            asked.append("--antialiased" if antialiased else "--no-antialiased")
        scene = cls.__new__(cls)
        scene._native = _machine.Scene.read(asked + ["--", path_bytes(path)])
        return scene

    def write(self, path: str | os.PathLike) -> dict[str, float]:
        """Writes the scene in the format of the path's ending, as splat convert does (docs/scenes.md).

        .ply is INRIA's PLY, which keeps every bit. The whole file appears or none. Returns the largest differences
        of what the file has: "position" (world units), "log_scale", "rotation" (of a unit quaternion's component),
        "opacity" (0 to 1), "color" (of constant coefficients), "harmonics" (of the others); "sh_degree", the degrees
        that it has less; and "drawing", whether it cannot say `antialiased` and `dilation`.
        """
        return self._native.write(path_bytes(path))

    def __len__(self) -> int:
        return self._native.size

    def __repr__(self) -> str:
        return f"<vorion.Scene of {len(self)} Gaussians, degree {self.sh_degree}>"

    @property
    def sh_degree(self) -> int:
        """Degree of the spherical harmonics, 0 to 3."""
        return self._native.sh_degree

    @property
    def format(self) -> str:
        """Of the file that it was read from, as "ply" or "spz"; "ply" for a scene of arrays."""
        return self._native.format

    @property
    def antialiased(self) -> bool:
        """Whether opacities are compensated for the dilation."""
        return self._native.antialiased

    @property
    def dilation(self) -> float | None:
        """Added to both variances on the picture, px^2; None for 0.3."""
        return self._native.dilation

    def _set(self, name, values):
        mine, values = getattr(self._native, name), np.asarray(values)
        if values.shape != mine.shape:
            raise UsageError(f"{name} has the shape {values.shape}, expected {mine.shape}")
        mine[...] = values

    @property
    def means(self) -> NDArray[np.float32] | NDArray[np.float64]:
        """(N, 3): x, y, z in world units; float64 and read-only where float32 has too few digits."""
        return self._native.means

    @means.setter
    def means(self, values: ArrayLike):
        values = np.asarray(values)
        mine = self._native.means
        if values.shape == mine.shape and (values.dtype != np.float32 or mine.dtype != np.float32):
            self._native.set_means(values)
        else:
            self._set("means", values)

    @property
    def log_scales(self) -> NDArray[np.float32]:
        """(N, 3): natural logarithms of standard deviations."""
        return self._native.log_scales

    @log_scales.setter
    def log_scales(self, values: ArrayLike):
        self._set("log_scales", values)

    @property
    def quats(self) -> NDArray[np.float32]:
        """(N, 4): w, x, y, z, of any length."""
        return self._native.quats

    @quats.setter
    def quats(self, values: ArrayLike):
        self._set("quats", values)

    @property
    def opacity_logits(self) -> NDArray[np.float32]:
        """(N,): opacity = 1 / (1 + exp(-logit))."""
        return self._native.opacity_logits

    @opacity_logits.setter
    def opacity_logits(self, values: ArrayLike):
        self._set("opacity_logits", values)

    @property
    def sh(self) -> NDArray[np.float32]:
        """(N, K, 3): coefficients of spherical harmonics, of red, green and blue."""
        return self._native.sh

    @sh.setter
    def sh(self, values: ArrayLike):
        self._set("sh", values)
