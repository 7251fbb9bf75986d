#!/usr/bin/env python3
"""Prints the exception of each wrong call. Runs in a folder with s.ply and c.json."""

import inspect

import numpy as np
import vorion
from vorion import _machine

scene, camera = vorion.Scene.read("s.ply"), vorion.Camera.read("c.json", "front")
v_image = np.zeros((48, 64, 3))


def attempt(call, *arguments, **options):
    try:
        call(*arguments, **options)
    except vorion.Error as e:
        code = f" {e.exit_code}" if hasattr(e, "exit_code") else ""
        print(f"{type(e).__name__}{code}: {e}")
        kinds = {"UsageError": ValueError, "LimitError": MemoryError}
        assert isinstance(e, kinds.get(type(e).__name__, RuntimeError))
    else:
        raise AssertionError(f"{call} {options}")


# An argument is named as it is, not as the variable that the platform reads.
attempt(vorion.Machine, set="clusters=0")
attempt(vorion.Machine, clock="fast")
machine = vorion.Machine()
for options in ({"support": "boxx"}, {"ztiles": 99}, {"path": "simt", "ztiles": 2}, {"effects": "nothing"},
                {"pixel_unit": "x"}, {"background": (1, 2)}, {"contributors": 65}, {"depth_as": "mean"},
                {"contributors": 1, "exp": "poly3"}, {"simt_group": 64}):
    attempt(machine.render, scene, camera, **options)
attempt(machine.gradients, scene, camera, v_image, path="simt", tile=64)
attempt(machine.gradients, scene, camera, v_image, path="simt", sum="rows")
attempt(machine.gradients, scene, camera, v_image[..., 0])
attempt(machine.gradients, scene, camera, v_image, np.zeros((1, 1)))
attempt(machine.gradients, scene, camera, np.full_like(v_image, np.nan))
attempt(machine.gradients, scene, camera, v_image, of="nothing")
attempt(vorion.Scene.read, "nowhere.ply")
attempt(vorion.Camera.read, "c.json", "back")
attempt(vorion.Scene.read, "s.ply", axes="rub")
bad = vorion.Scene.read("s.ply")
bad.means[0, 1] = np.nan
attempt(machine.render, bad, camera)
attempt(vorion.Machine, set="dram.channels=1")
attempt(bad.write, "bad.ply")
attempt(scene.write, "s.obj")
attempt(scene.write, "nowhere/s.ply")
arrays = {"means": np.zeros((1, 3)), "quats": np.ones((1, 4)), "scales": np.ones((1, 3)), "opacities": np.ones(1),
          "colors": np.ones((1, 3))}
attempt(vorion.Scene.from_activated, **{**arrays, "means": np.zeros((2, 3))})
attempt(vorion.Scene.from_activated, **{**arrays, "colors": np.ones((1, 2, 3))})
attempt(vorion.Scene.from_activated, **{**arrays, "scales": np.zeros((1, 3))})
attempt(vorion.Scene.from_activated, **{**arrays, "opacities": np.full(1, 1.5)})
attempt(vorion.Scene.from_activated, **arrays, dilation=1e39)
attempt(vorion.Camera, 0, 5, np.eye(3))
attempt(vorion.Camera, 5, 5, np.diag([-1, 1, 1]))
attempt(vorion.Camera, 5, 5, np.eye(3), np.diag([1, 1, -1, 1]))
attempt(vorion.Camera, 5, 5, np.ones((3, 3)))
attempt(machine.render, scene, vorion.Camera(16384, 16384, np.diag([16384, 16384, 1])))
corners, faces = np.eye(3), [[0, 1, 2]]
attempt(vorion.Mesh, corners[:, :2], faces)
attempt(vorion.Mesh, np.zeros((0, 3)), faces)
attempt(vorion.Mesh, corners, [[0, 1, 3]])
attempt(vorion.Mesh, corners, [[0, 1, -1]])
attempt(vorion.Mesh, corners, [[0, 1.0, 2]])
attempt(vorion.Mesh, corners, [0, 1, 2])
attempt(vorion.Mesh, np.full((3, 3), np.inf), faces)
attempt(vorion.Mesh, corners * 1e39, faces)
attempt(vorion.Mesh, [["a", "b", "c"]] * 3, faces)
attempt(vorion.Mesh, corners, faces, corners[:2])
attempt(vorion.Mesh, corners, faces, 2 * corners)
attempt(vorion.Mesh, corners, faces, normals=corners[None, None])
attempt(vorion.Mesh, corners, faces, uv=corners[:, :2])
attempt(vorion.Mesh, corners, faces, uv=corners[:, :2], texture=corners)
attempt(vorion.Mesh, corners, faces, alpha="glass")
attempt(vorion.Mesh.read, "s.ply")
attempt(machine.render, scene, camera, mesh="m.obj")
attempt(machine.render, scene, camera, light=(0, 0, 1))
mesh, pane = vorion.Mesh(corners, faces), vorion.Mesh(corners, faces, alpha="blend")
attempt(machine.render, scene, camera, mesh=mesh, light=(0, 0, 0))
attempt(machine.render, scene, camera, mesh=mesh, normals=True)
attempt(machine.render, scene, camera, mesh=pane, depth=True)
attempt(machine.render, scene, camera, mesh=pane, ztiles=2)
attempt(machine.gradients, scene, camera, v_image, mesh=pane)
attempt(machine.render, "s.ply", camera)
attempt(machine.render, scene, [camera])
attempt(machine.gradients, 3, camera, v_image)
attempt(vorion.Camera, 64.5, 48, np.eye(3))
attempt(vorion.Machine, set={"dram": 1})
# An error leaves the machine as it was.
print("again:", machine.render(scene, camera).report["counts"]["visible"])

# The signatures have every option of the commands, and no other.
for method, names, own in ((machine.render, _machine.render_options(), {"scene", "camera", "mesh", "depth", "normals", "visible", "time"}),
                           (machine.gradients, _machine.gradient_options(),
                            {"scene", "camera", "mesh", "v_image", "v_alpha", "of", "time"})):
    named = {n.replace("-", "_") for n in names}
    assert set(inspect.signature(method).parameters) == named | own, named ^ (set(inspect.signature(method).parameters) - own)
    for name in named | own:
        assert name in method.__doc__ or name in vorion.Machine.render.__doc__, name
