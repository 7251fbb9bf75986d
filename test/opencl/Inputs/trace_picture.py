"""Writes a trace of random triangles in the states that apps/samples/triangles draws, and the picture by Skybox's rules.

usage: trace_picture.py TRACE.npz PICTURE.png WIDTH HEIGHT SEED [CHANGE]
   or: trace_picture.py --of TRACE.npz PICTURE.png WIDTH HEIGHT
The picture is computed with NumPy, a triangle at a time (apps/samples/README.md). --of: of a trace that
exists. CHANGE: what is wrong with the trace, a key of CHANGES.
"""

import pathlib
import sys

import numpy as np

sys.path.append(str(pathlib.Path(__file__).resolve().parents[2] / "Inputs"))
import png_file

TILE, DEPTH_BITS, FRACTION, TEXTURE_FRACTION = 32, 24, 24, 23
NAMES = ("depth_test depth_writemask depth_func stencil_test texture_enabled texture_envmode texture_minfilter "
         "texture_magfilter texture_addressU texture_addressV blend_enabled blend_src blend_dst").split()
LINEAR, CLAMP, REPLACE, MODULATE = 2, 1, 2, 3


def fixed(values):
    """8.24 of float32, truncated."""
    return np.trunc(np.asarray(values, np.float64) * 2 ** FRACTION).astype(np.int64)


def edges_of(x, y, w):
    """Rows a, b, c in 16.16 for samples at pixels' centres; None without area."""
    edges = np.zeros((3, 3), np.float32)
    for k in range(3):
        i, j = (k + 1) % 3, (k + 2) % 3
        edges[k] = y[i] * w[j] - y[j] * w[i], x[j] * w[i] - x[i] * w[j], x[i] * y[j] - x[j] * y[i]
    area = edges[0, 2] * w[0] + edges[1, 2] * w[1] + edges[2, 2] * w[2]
    if area == 0:
        return None
    if area < 0:
        edges = -edges
    edges[:, 2] += edges[:, 0] * np.float32(0.5) + edges[:, 1] * np.float32(0.5)
    edges *= np.float32(1) / np.abs(edges[:, :2]).max()
    return np.trunc(edges.astype(np.float64) * 65536).astype(np.int64)


def tiles_of(at, size):
    """First pixel, and the one after the last, of the tiles that an extent touches; empty if it is outside."""
    first, end = max(int(np.floor(at.min())), 0), min(int(np.ceil(at.max())), size)
    return (first // TILE * TILE, min(-(-end // TILE) * TILE, size)) if first < end else (0, 0)


def texels(state, texture, u, v):
    height, width, _ = texture.shape
    shifts = [TEXTURE_FRACTION - (size.bit_length() - 1) for size in (width, height)]
    whole = 1 << TEXTURE_FRACTION

    def wrapped(at):
        return np.clip(at, 0, whole - 1) if state["texture_addressU"] == CLAMP else at & (whole - 1)

    if state["texture_magfilter"] != LINEAR:
        return texture[wrapped(v) >> shifts[1], wrapped(u) >> shifts[0]]
    halves = [1 << (s - 1) for s in shifts]
    u0, u1, v0, v1 = wrapped(u - halves[0]), wrapped(u + halves[0]), wrapped(v - halves[1]), wrapped(v + halves[1])
    weights = [(low >> (s - 8) & 255)[:, None] for low, s in ((u0, shifts[0]), (v0, shifts[1]))]

    def mixed(a, b, weight):
        p = a * (255 - weight) + b * weight + 128
        return (p + (p >> 8)) >> 8

    x0, x1, y0, y1 = u0 >> shifts[0], u1 >> shifts[0], v0 >> shifts[1], v1 >> shifts[1]
    return mixed(mixed(texture[y0, x0], texture[y0, x1], weights[0]),
                 mixed(texture[y1, x0], texture[y1, x1], weights[0]), weights[1])


def blended(state, source, under):
    def factor(number):
        ones = np.full_like(source, 255)
        value = [0 * source, source, source[:, 3:] + 0 * source, under[:, 3:] + 0 * source, under][number // 2]
        return ones - value if number % 2 else value

    total = np.minimum(source * factor(state["blend_src"]) + under * factor(state["blend_dst"]) + 128, 0xFF00)
    return (total + (total >> 8)) >> 8


class Target:
    def __init__(self, width, height):
        self.size = width, height
        self.colors = np.zeros((height, width, 4), np.int64)
        self.colors[..., 3] = 255
        self.depths = np.full((height, width), 2 ** DEPTH_BITS - 1, np.int64)

    def draw(self, state, texture, positions, depths, values):
        """A triangle. values: red, green, blue, alpha, u, v of each corner."""
        x, y, w = positions.T
        edges = edges_of(x, y, w)
        columns, rows = (tiles_of(at * (np.float32(1) / w), size) for at, size in zip((x, y), self.size))
        if edges is None or columns[0] == columns[1] or rows[0] == rows[1]:
            return
        py, px = np.mgrid[rows[0]:rows[1], columns[0]:columns[1]]
        at = [a * px + b * py + c for a, b, c in edges]
        inside = np.all([e >= 0 for e in at], axis=0)
        px, py = px[inside], py[inside]
        at = [e[inside].astype(np.float32) for e in at]
        once = np.float32(1) / (at[0] + at[1] + at[2])
        weights = [fixed(e * once) for e in at[:2]]

        def interpolated(corners):
            steps = [fixed(corners[k] - corners[2]) * weights[k] >> FRACTION for k in range(2)]
            return fixed(corners[2]) + steps[0] + steps[1]

        values = [interpolated(corners) for corners in values.T]
        passes = np.full(px.shape, True)
        if state["depth_test"]:
            new, old = interpolated(depths) & (2 ** DEPTH_BITS - 1), self.depths[py, px]
            passes = [passes & False, new < old, new == old, new <= old, new > old, new != old, new >= old,
                      passes][state["depth_func"]]
            if state["depth_writemask"]:
                self.depths[py[passes], px[passes]] = new[passes]
        px, py, values = px[passes], py[passes], [v[passes] for v in values]
        own = np.stack(values[:4], axis=-1)
        color = texels(state, texture, *(v >> 1 for v in values[4:])) if state["texture_enabled"] else 255
        if not state["texture_enabled"] or state["texture_envmode"] == MODULATE:
            color = own * color >> FRACTION & 255
        if state["blend_enabled"]:
            color = blended(state, color, self.colors[py, px])
        self.colors[py, px] = color


def picture_of(arrays, width, height):
    """Rows from the top of pixels with four bytes."""
    target, half = Target(width, height), np.array([width, height], np.float32) / 2
    names = arrays["state_names"].tolist()
    for draw, row in enumerate(arrays["states"]):
        state = dict(zip(names, row.tolist()))
        vertices, triangles = (slice(*arrays[f"draw_{kind}_start"][draw:draw + 2]) for kind in ("vertex", "triangle"))
        clip = arrays["vertex_clip_xyzw"][vertices]
        w = clip[:, 3:]
        positions = np.hstack([clip[:, :2] * half + w * half, w])
        near, far = arrays["viewport"][draw, 4:]
        depths = clip[:, 2] * (np.float32(1) / w[:, 0]) * ((far - near) / np.float32(2)) + (near + far) / np.float32(2)
        values = np.hstack([arrays["vertex_rgba"][vertices], arrays["vertex_uv"][vertices]])
        texture = None
        if state["texture_enabled"]:
            texture = arrays[f"texture_{arrays['texture_id'][draw]}_rgba"].astype(np.int64)
        for corners in arrays["triangles"][triangles]:
            target.draw(state, texture, positions[corners], depths[corners], values[corners])
    return target.colors[::-1].astype(np.uint8)


def random_triangles(engine, count):
    """Vertices in clip space, of triangles from less than a pixel to more than the picture; some share edges."""
    w = engine.uniform(0.5, 3, (3 * count, 1)) if engine.random() < 0.7 else np.ones((3 * count, 1))
    reach = np.repeat(2.0 ** engine.uniform(-7, 0, count), 3)[:, None]
    at = np.repeat(engine.uniform(-1, 1, (count, 2)), 3, axis=0) + reach * engine.uniform(-1, 1, (3 * count, 2))
    depth = engine.uniform(-0.99, 0.99, (3 * count, 1))
    clip = np.hstack([at, depth, np.ones_like(w)]) * w
    # A corner behind the camera.
    clip[::31, 3] *= -1
    triangles = np.arange(3 * count).reshape(count, 3)
    triangles[1::4, 0], triangles[1::4, 1] = triangles[::4, 1][:len(triangles[1::4])], triangles[::4, 2][:len(triangles[1::4])]
    return clip, triangles


def random_trace(seed):
    engine = np.random.default_rng(seed)
    textures = {"texture_0_rgba": engine.integers(0, 256, (16, 8, 4)), "texture_7_rgba": engine.integers(0, 256, (1, 64, 4))}
    states, starts, parts = [], [(0, 0)], []
    kinds = [{"depth_test": 1, "depth_writemask": 1, "depth_func": f} for f in (1, 3, 4, 1, 2, 5, 6, 7, 0)]
    kinds += [{}] + [{"blend_enabled": 1, "blend_src": n, "blend_dst": 9 - n} for n in range(10)]
    for n, kind in enumerate(kinds):
        textured = {"texture_enabled": int(n % 3 > 0), "texture_envmode": (REPLACE, MODULATE)[n % 2],
                    "texture_magfilter": 1 + n // 2 % 2, "texture_addressU": n // 3 % 2}
        state = dict.fromkeys(NAMES, 0) | textured | kind
        states.append([state[name] for name in NAMES])
        clip, triangles = random_triangles(engine, 30)
        parts.append((clip, engine.uniform(0, 1, (len(clip), 4)), engine.uniform(-1, 2, (len(clip), 2)), triangles))
        starts.append((starts[-1][0] + len(clip), starts[-1][1] + len(triangles)))
    clip, rgba, uv, triangles = (np.concatenate(all_of) for all_of in zip(*parts))
    return {
        "vertex_clip_xyzw": clip.astype(np.float32), "vertex_rgba": rgba.astype(np.float32),
        "vertex_uv": uv.astype(np.float32), "triangles": triangles.astype(np.int32),
        "draw_vertex_start": np.array(starts)[:, 0], "draw_triangle_start": np.array(starts)[:, 1],
        "states": np.array(states), "state_names": np.array(NAMES),
        "viewport": np.array([[0, 800, 0, 600, 0, 1]] * len(states), np.float32),
        "texture_id": np.array([7 * (n % 2) for n in range(len(states))]),
    } | {name: texture.astype(np.uint8) for name, texture in textures.items()}


def with_state(name, value):
    def change(arrays):
        arrays["states"][9, NAMES.index(name)] = value
    return change


CHANGES = {
    "missing": lambda arrays: arrays.pop("viewport"),
    "shape": lambda arrays: arrays.update(vertex_uv=arrays["vertex_rgba"]),
    "vertex": lambda arrays: arrays["triangles"].__setitem__((70, 1), 5000),
    "texture": lambda arrays: arrays.pop("texture_7_rgba"),
    "size": lambda arrays: arrays.update(texture_7_rgba=np.zeros((3, 8, 4), np.uint8)),
    "stencil": with_state("stencil_test", 1),
    "saturate": lambda arrays: arrays["states"][12].__setitem__(NAMES.index("blend_src"), 10),
}


def main():
    is_given = sys.argv[1] == "--of"
    trace, picture, width, height, *rest = sys.argv[1 + is_given:]
    if is_given:
        with np.load(trace) as file:
            arrays = dict(file)
    else:
        arrays = random_trace(int(rest[0]))
    if not rest[1:]:
        rows = picture_of(arrays, int(width), int(height))
        png_file.write(picture, [row.tobytes() for row in rows], 4)
    for change in rest[1:]:
        CHANGES[change](arrays)
    if not is_given:
        np.savez_compressed(trace, **arrays)


if __name__ == "__main__":
    main()
