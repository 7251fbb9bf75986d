"""The renderer splat on the simulated machine, for NumPy.

    import vorion
    scene = vorion.Scene.read("scene.ply")
    camera = vorion.Camera.read("cameras.json", "front")
    machine = vorion.Machine()
    picture = machine.render(scene, camera, depth=True, time=True)
    picture.image      # H x W x 3, float32
    picture.counters   # what the machine counted
    picture.cycles     # what the frame takes on it

    back = machine.gradients(scene, camera, v_image)
    back.by["means"]   # dL/d(means), N x 3

Pictures and gradients have the same bits as those of `splat render` and `splat gradients`. Options have the names and
meanings of those commands. docs/python.md of the project says more.
"""

from . import _tree  # first: shows the device to OpenCL
from ._machine import Error, InputError, LimitError, TrapError, UsageError, __version__
from .camera import Camera, cameras, read_cameras, write_cameras
from .command import command, compare
from .machine import Contributors, Gradients, Machine, Picture
from .mesh import Mesh
from .scene import Scene

__all__ = ["Camera", "Contributors", "Error", "Gradients", "InputError", "LimitError", "Machine", "Mesh", "Picture",
           "Scene", "TrapError", "UsageError", "__version__", "cameras", "command", "compare", "read_cameras", "write_cameras"]
