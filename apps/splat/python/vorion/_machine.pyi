"""What the library in C++ has, for type checkers."""

import numpy as np
from numpy.typing import NDArray

__version__: str

class Error(RuntimeError):
    where: str
    exit_code: int
    build_log: str

class UsageError(Error, ValueError): ...
class InputError(Error): ...
class TrapError(Error): ...
class LimitError(Error, MemoryError): ...

class Scene:
    @staticmethod
    def sized(gaussians: int, sh_degree: int, antialiased: bool, dilation: float | None) -> Scene: ...
    @staticmethod
    def read(words: list[str | bytes]) -> Scene: ...
    def write(self, path: bytes) -> dict[str, float]: ...
    def set_means(self, values: NDArray[np.float64]) -> None: ...
    size: int
    sh_degree: int
    format: str
    antialiased: bool
    dilation: float | None
    means: NDArray[np.float32] | NDArray[np.float64]
    log_scales: NDArray[np.float32]
    quats: NDArray[np.float32]
    opacity_logits: NDArray[np.float32]
    sh: NDArray[np.float32]

class Mesh:
    @staticmethod
    def made(vertices: NDArray[np.float32], colors: NDArray[np.float32], triangles: NDArray[np.uint32],
             normals: NDArray[np.float32] | None, uv: NDArray[np.float32] | None, texels: NDArray[np.uint8] | None,
             alpha: int, alpha_cutoff: float) -> Mesh: ...
    @staticmethod
    def read(path: bytes) -> Mesh: ...
    size: int
    vertices: NDArray[np.float32]
    colors: NDArray[np.float32]
    triangles: NDArray[np.int32]

class Camera:
    def __init__(self, name: str, width: int, height: int, intrinsics: list[float], rotation: list[list[float]],
                 position: list[float]) -> None: ...
    @staticmethod
    def found(scene: Scene, width: int, height: int) -> Camera: ...
    @staticmethod
    def read(path: bytes, view: str) -> Camera: ...
    @staticmethod
    def read_all(path: bytes) -> list[Camera]: ...
    name: str
    model: str
    width: int
    height: int
    rotation: list[list[float]]
    position: list[float]
    intrinsics: tuple[float, float, float, float]

def cameras(scene: Scene, words: list[str]) -> list[Camera]: ...
def write_cameras(path: bytes, cameras: list[Camera]) -> None: ...

class Machine:
    def __init__(self, device: str, options: dict[str, tuple[str, str]]) -> None: ...
    name: str
    def render(self, scene: Scene, camera: Camera, mesh: Mesh | None, words: list[str], depth: bool, normals: bool,
               visible: bool, time: bool) -> tuple[NDArray[np.float32], NDArray[np.float32], dict, dict]: ...
    def gradients(self, scene: Scene, camera: Camera, mesh: Mesh | None, v_image: object, v_alpha: object,
                  words: list[str], stored: bool, time: bool) -> tuple[NDArray[np.float32], NDArray[np.float32], dict, dict]: ...

def ssim(a: NDArray[np.float64], b: NDArray[np.float64]) -> float: ...
def render_options() -> list[str]: ...
def gradient_options() -> list[str]: ...
