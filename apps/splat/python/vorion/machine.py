"""The simulated machine, and what comes back from it."""

from __future__ import annotations

import dataclasses

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _machine
from ._machine import UsageError
from ._words import words
from .camera import Camera
from .mesh import Mesh
from .scene import Scene


def _check(value, kind, name):
    if not isinstance(value, kind):
        raise UsageError(f"{name} is a {type(value).__name__}, expected a vorion.{kind.__name__}")


def _native_mesh(mesh):
    if mesh is None:
        return None
    _check(mesh, Mesh, "mesh")
    return mesh._native


@dataclasses.dataclass(frozen=True, eq=False)
class _Drawn:
    image: NDArray[np.float32]
    """(H, W, 3): red, green, blue over the background, rows from the top, not clamped."""
    alpha: NDArray[np.float32]
    """(H, W): 1 less what is left of the transmittance."""
    report: dict
    """What was done, as `splat render --json` writes it, but for files: options, device, counts, stages and kernels
    with their counters, and "time" where the clock was on."""

    @property
    def counters(self) -> dict | None:
        """What the machine counted over all kernels; None on a device that counts nothing."""
        return self.report["total"].get("counters")

    @property
    def cycles(self) -> int | None:
        """What the kernels of the frame take on the machine; None where its clock was off."""
        return self.report["time"]["sum"]["cycles"] if "time" in self.report else None

    @property
    def effects(self) -> list[dict]:
        """Of each effect its "name", whether it is "needed" and "on", and why (docs/effects.md)."""
        return self.report["effects"]

    @property
    def joules(self) -> float | None:
        """The frame's energy, where `energy` asked for it (docs/energy.md); the report's "energy" has its parts."""
        return self.report["energy"]["joules"]["value"] if "energy" in self.report else None

    @property
    def milliseconds(self) -> float | None:
        """The same with launches and copies, at the machine's clock."""
        return self.report["time"]["frame_ms"] if "time" in self.report else None


@dataclasses.dataclass(frozen=True, eq=False)
class Contributors:
    """The N Gaussians with the largest weights of each pixel, the largest first; then -1 and 0."""
    index: NDArray[np.int32]
    """(H, W, N): numbers in the scene."""
    weight: NDArray[np.float32]
    """(H, W, N): alpha times the transmittance in front."""
    count: NDArray[np.int32]
    """(H, W): how many the pixel blends in all."""


@dataclasses.dataclass(frozen=True, eq=False)
class Picture(_Drawn):
    """What Machine.render() gives."""
    depth: NDArray[np.float32] | None = None
    """(H, W), where it was asked for: by default the sum of weights times depths (camera z) in world units; over alpha
    it is the mean depth of what is seen."""
    normals: NDArray[np.float32] | None = None
    """(H, W, 3), where they were asked for: the sum of weights times normals, in the world's axes."""
    contributors: Contributors | None = None
    """What pixels are made of, where it was asked for."""
    visible: dict[str, NDArray] | None = None
    """Where it was asked for, the arrays of `splat render --visible`: "depth" and "triangle" of the mesh, (H, W), infinite
    and -1 where it is not; of transparent triangles "layer_depth" and "layer_triangle" (N, H, W)."""


@dataclasses.dataclass(frozen=True, eq=False)
class Gradients(_Drawn):
    """What Machine.gradients() gives: the picture, and the loss's gradients."""
    by: dict[str, NDArray[np.float32]] = dataclasses.field(default_factory=dict)
    """dL by the parameters, in their shapes: "means", "quats" as they are stored, "sh", and either "scales" and
    "opacities" or "log_scales" and "opacity_logits". Also "means2d" (N, 2), by places on the picture, per pixel, and
    "conics" (N, 3), by xx, xy (once) and yy of the inverse covariances there."""


class Machine:
    """The simulated machine with the programs that were compiled for it.

    A process has one set of machine options: a second Machine with other ones is a UsageError. Methods
    release the GIL while the machine runs; two threads that call one Machine take turns.
    """

    def __init__(self, *, device: str = "", set: str | None = None, clock: int | None = None):
        """Opens the device.

        device: part of its name; empty for Vorion, else the first OpenCL device
        set: changes to the machine's configuration, "KEY=VALUE,..." (docs/model.md)
        clock: MHz; the clock is then always on. None for the machine's own, on where `time` asks for it.
        VORION_CONFIG and the other variables of docs/debugging.md hold, too.
        """
        options = {}
        if not isinstance(set, str | None):
            raise UsageError(f"set is a {type(set).__name__}, expected a text, KEY=VALUE,...")
        if "\0" in (set or ""):
            raise UsageError("set holds a NUL, expected a text without one")
        if set is not None:
            options["VORION_SET"] = (set, "set")
        if not isinstance(clock, int | float | None) or isinstance(clock, bool):
            raise UsageError(f"clock is a {type(clock).__name__}, expected a number of MHz")
        if clock is not None:
            options["VORION_TIME"] = (f"{clock}MHz", "clock")
        self._native = _machine.Machine(device, options)

    def __repr__(self) -> str:
        return f"<vorion.Machine {self.name!r}>"

    @property
    def name(self) -> str:
        """The OpenCL device's."""
        return self._native.name

    def render(self, scene: Scene, camera: Camera, *, mesh: Mesh | None = None,
               light: tuple[float, float, float] | None = None, depth: bool = False, normals: bool = False,
               visible: bool = False, time: bool = False, depth_as: str | None = None, contributors: int | None = None,
               rules: str | None = None, support: str | None = None, path: str | None = None,
               background: tuple[float, float, float] | None = None, cutoff: float | None = None,
               exp: str | None = None, alpha_cutoff: int | None = None, depth_bits: int | None = None,
               sh_degree: int | None = None, blend: str | None = None, tile: int | None = None,
               ztiles: int | None = None, pixel_unit: str | None = None, skip_saturated: bool | None = None,
               simt_group: int | None = None, effects: str | None = None,
               near: float | None = None, projection: str | None = None, order: str | None = None,
               ray_window: int | None = None, cull_blocks: bool | None = None, energy: bool | None = None,
               technology: str | None = None, voltage: float | None = None, given_chip: bool | None = None,
               subpixel_bits: int | None = None, mesh_depth: str | None = None, filter_bits: int | None = None) -> Picture:
        """Draws `scene` as `camera` sees it.

        mesh: triangles that are drawn with the Gaussians (docs/meshes.md)
        light: direction in the world's axes in which a light shines on them; None for colours as they are
        depth: blend depths, too
        normals: blend normals, too: of each Gaussian its shortest axis, towards the camera
        visible: keep the mesh's depth and triangle of each pixel, too
        contributors: keep so many Gaussians of each pixel, up to 64, those with the largest weights
        depth_as: what stands for a pixel's depths: "accumulated", "expected" or "median"
        time: run the machine's clock, which takes the host longer and changes no bit

        The rest are options of `splat render`, whose --help says more; None is its default.
        rules: "inria" or "gsplat", the convention to follow
        support: "exact", "box3", "square3" or "official16", the pixels that a Gaussian may reach
        path: "raster" or "simt", who blends: the rasterizer or the cores
        background: red, green, blue
        cutoff: transmittance at which a pixel is full, [0, 1)
        exp: unit of the exponential function
        alpha_cutoff: smallest alpha that is blended, in 1/255: 1, 2, 4 or 8
        depth_bits: leading bits of depths that decide the order, 1 to 32
        sh_degree: leave out harmonics above it, 0 to 3
        tile: side of a tile in pixels
        blend, ztiles, pixel_unit, skip_saturated: of the rasterizer
        simt_group: of the cores' path
        effects: what is compiled into the kernels; "flags" compiles once for all scenes, which loops want
        near: least depth that is drawn; the rules have one
        projection: "jacobian" or "unscented", how a covariance goes through the camera
        order: "depth" or "ray", the depths by which a pixel of the cores' path blends
        ray_window: Gaussians that it finds at a time by "ray": 4, 8 or 16; changes no bit
        cull_blocks: leave out blocks of Gaussians of which a pinhole sees none; changes no bit
        energy, technology, voltage: run the clock, and count joules with a file of a process node, at volts
        given_chip: count them also given the published area and power of the technology's chip
        subpixel_bits, mesh_depth, filter_bits: approximations of a mesh (docs/meshes.md)
        """
        _check(scene, Scene, "scene")
        _check(camera, Camera, "camera")
        asked = words({"rules": rules, "support": support, "path": path, "background": background, "cutoff": cutoff,
                       "light": light, "exp": exp, "alpha_cutoff": alpha_cutoff, "depth_bits": depth_bits, "sh_degree": sh_degree,
                       "blend": blend, "tile": tile, "ztiles": ztiles, "pixel_unit": pixel_unit,
                       "skip_saturated": skip_saturated, "simt_group": simt_group, "effects": effects,
                       "near": near, "projection": projection, "order": order,
                       "ray_window": ray_window, "cull_blocks": cull_blocks, "depth_as": depth_as,
                       "contributors": contributors, "energy": energy, "technology": technology, "voltage": voltage,
                       "given_chip": given_chip,
                       "subpixel_bits": subpixel_bits, "mesh_depth": mesh_depth, "filter_bits": filter_bits})
        image, alpha, by, report = self._native.render(scene._native, camera._native, _native_mesh(mesh), asked, depth,
                                                       normals, visible, time)
        top = by["contributors"]
        return Picture(image, alpha, report, by["depth"], by["normals"], Contributors(*top) if top else None,
                       by["visible"])

    def gradients(self, scene: Scene, camera: Camera, v_image: ArrayLike, v_alpha: ArrayLike | None = None, *,
                  mesh: Mesh | None = None, light: tuple[float, float, float] | None = None, of: str = "activated", time: bool = False,
                  rules: str | None = None, support: str | None = None, path: str | None = None,
                  background: tuple[float, float, float] | None = None, cutoff: float | None = None, tile: int | None = None, simt_group: int | None = None,
                  reciprocal: str | None = None, sum: str | None = None, simt_sums: str | None = None,
                  near: float | None = None, projection: str | None = None) -> Gradients:
        """Draws `scene` as `camera` sees it, and takes a loss's gradients back to its parameters.

        v_image: (H, W, 3), dL/d(image), the background being in it
        v_alpha: (H, W), dL/d(alpha); None for zeros
        of: "activated" for dL by scales and opacities, "stored" for dL by log_scales and opacity_logits
        reciprocal, sum: the rasterizer's unit for 1 / (1 - alpha), and how it adds up rows
        simt_sums: how the cores' way back adds up pixels, "ordered", "atomics" or "warp"
        The other options are those of render(). Harmonics have all the scene's degrees. A mesh must be opaque.
        """
        _check(scene, Scene, "scene")
        _check(camera, Camera, "camera")
        if of not in ("activated", "stored"):
            raise UsageError(f"of={of!r}: expected 'activated' or 'stored'")
        asked = words({"rules": rules, "support": support, "path": path, "background": background, "cutoff": cutoff,
                       "tile": tile, "simt_group": simt_group, "reciprocal": reciprocal, "sum": sum,
                       "simt_sums": simt_sums, "near": near, "projection": projection, "light": light})
        if v_alpha is None:
            v_alpha = np.zeros((camera.height, camera.width), dtype=np.float32)
        image, alpha, by, report = self._native.gradients(scene._native, camera._native, _native_mesh(mesh), v_image, v_alpha,
                                                          asked, of == "stored", time)
        return Gradients(image, alpha, report, by)
