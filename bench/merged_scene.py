"""A scene with fewer Gaussians: groups of neighbours become one of the same moments."""

import os
import subprocess

import numpy as np

import scenes

# Properties of a scene of degree 0, as `splat convert` writes it.
PROPERTIES = ("x", "y", "z", "f_dc_0", "f_dc_1", "f_dc_2", "opacity", "scale_0", "scale_1", "scale_2", "rot_0", "rot_1", "rot_2", "rot_3")
MOST_OPAQUE = 0.99


def _read(path):
    with open(path, "rb") as file:
        head, data = file.read().split(b"end_header\n", 1)
    names = [line.split()[-1].decode() for line in head.splitlines() if line.startswith(b"property float")]
    rows = np.frombuffer(data, "<f4").reshape(-1, len(names)).astype(float)
    return {name: rows[:, names.index(name)] for name in PROPERTIES}


def _columns(scene, *names):
    return np.stack([scene[name] for name in names], axis=-1)


def _rotations(quats):
    w, x, y, z = (quats / np.linalg.norm(quats, axis=1, keepdims=True)).T
    rows = ((1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)),
            (2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)),
            (2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)))
    return np.stack([np.stack(row, -1) for row in rows], -2)


def _quats(turns):
    """Of rotations, by the symmetric matrix whose largest eigenvector is the quaternion."""
    def entry(i, j):
        return turns[:, i, j]
    m = np.empty((len(turns), 4, 4))
    for k in range(3):
        i, j = (k + 1) % 3, (k + 2) % 3
        m[:, 0, k + 1] = m[:, k + 1, 0] = entry(j, i) - entry(i, j)
        m[:, k + 1, k + 1] = entry(k, k) - entry(i, i) - entry(j, j)
        m[:, i + 1, j + 1] = m[:, j + 1, i + 1] = entry(i, j) + entry(j, i)
    m[:, 0, 0] = entry(0, 0) + entry(1, 1) + entry(2, 2)
    return np.linalg.eigh(m)[1][:, :, 3]


def _area(log_scales):
    return np.exp(np.sort(log_scales, axis=-1)[..., 1:].sum(-1))


def _merge(scene, count):
    """Of each `count` neighbours one; the last few that are no such group are left out."""
    groups = np.arange(len(scene["x"]) // count * count).reshape(-1, count)
    places, scales = _columns(scene, "x", "y", "z"), _columns(scene, "scale_0", "scale_1", "scale_2")
    turns = _rotations(_columns(scene, "rot_0", "rot_1", "rot_2", "rot_3"))
    covariances = (turns * np.exp(2 * scales)[:, None, :]) @ turns.transpose(0, 2, 1)
    weights = (_area(scales) / (1 + np.exp(-scene["opacity"])))[groups]
    weights, sums = weights / weights.sum(1, keepdims=True), weights.sum(1)
    middles = np.einsum("gn,gnk->gk", weights, places[groups])
    away = places[groups] - middles[:, None]
    moments = np.einsum("gn,gnij->gij", weights, covariances[groups] + away[..., :, None] * away[..., None, :])
    squares, axes = np.linalg.eigh(moments)
    axes[:, :, 0] *= np.linalg.det(axes)[:, None]  # a rotation
    log_scales = 0.5 * np.log(np.maximum(squares, 1e-20))
    opacities = np.minimum(MOST_OPAQUE, sums / _area(log_scales))
    colours = np.einsum("gn,gnk->gk", weights, _columns(scene, "f_dc_0", "f_dc_1", "f_dc_2")[groups])
    logits = np.log(opacities / (1 - opacities))
    return np.concatenate([middles, colours, logits[:, None], log_scales, _quats(axes)], axis=1)


def _write(path, rows):
    head = ["ply", "format binary_little_endian 1.0", f"element vertex {len(rows)}", *(f"property float {name}" for name in PROPERTIES),
            "end_header", ""]
    with open(path, "wb") as file:
        file.write("\n".join(head).encode() + rows.astype("<f4").tobytes())


def merged(path, count, folder):
    """Writes the scene with `count` neighbours in Morton order merged to one, of degree 0, into the folder; returns the file.
    A Gaussian's weight is its opacity times the area of its two larger axes; the merged one has the group's area of opacity."""
    os.makedirs(folder, exist_ok=True)
    name = os.path.basename(path).split(".")[0]
    out = os.path.join(folder, f"{name}-{count}.ply")
    if os.path.exists(out):
        return out
    whole = os.path.join(folder, name + ".ply")
    subprocess.run(["splat", "convert", path, "--morton-order", "--sh-degree", "0", "-o", whole], check=True, cwd=scenes.ROOT,
                   stdout=subprocess.DEVNULL)
    _write(out, _merge(_read(whole), count))
    os.remove(whole)
    return out
