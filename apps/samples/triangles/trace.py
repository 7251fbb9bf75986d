#!/usr/bin/env python3
"""Draws a trace of recorded triangles by Skybox's rules: kernels set up and shade, the rasterizer covers.

The trace is an .npz file with vertices in clip space, triangles, textures and states of draws (../README.md).
"""
import argparse
import pathlib
import struct
import sys
import zipfile
import zlib

import numpy as np
import pyopencl as cl

KERNELS = pathlib.Path(__file__).with_name("trace.cl")
TILE = 32  # as in trace.cl
GROUP = 16
FARTHEST = 0xFFFFFF
TRIANGLE_BYTES, ATTRIBUTE_BYTES = 72, 84
LINEAR, CLAMP, MODULATE, SATURATE = 2, 1, 3, 10

# draw_state of trace.cl.
STATE = np.dtype([(name, "<f4" if name in ("near", "far") else "<u4") for name in (
    "width height near far triangles depth_test depth_write depth_function textured log_width log_height linear clamped "
    "modulated blended source destination").split()])
VISIBILITY = np.dtype([("depth", "<f4"), ("primitive", "<u4")])
# Arrays of a trace, and the rows' shape.
ARRAYS = {"vertex_clip_xyzw": (4,), "vertex_rgba": (4,), "vertex_uv": (2,), "triangles": (3,), "draw_vertex_start": (),
          "draw_triangle_start": (), "states": None, "state_names": (), "viewport": (6,), "texture_id": ()}


class BadFile(Exception):
    pass


def chunk(kind, body):
    return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))


def write_png(path, picture):
    """picture: rows from the top, of pixels with four bytes."""
    height, width, _ = picture.shape
    lines = b"".join(b"\0" + row.tobytes() for row in picture)
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 6, 0, 0, 0)) +
                   chunk(b"IDAT", zlib.compress(lines, 9)) + chunk(b"IEND", b""))


def unfiltered(kind, line, above, channels):
    """A line of a PNG before its filter, which took each byte's neighbours from it."""
    line = bytearray(line)
    for i, byte in enumerate(line):
        left = line[i - channels] if i >= channels else 0
        corner = above[i - channels] if i >= channels else 0
        linear = left + above[i] - corner
        nearest = min((left, above[i], corner), key=lambda near: abs(linear - near))
        line[i] = byte + (0, left, above[i], (left + above[i]) // 2, nearest)[kind] & 255
    return line


def read_png(path):
    """Rows from the top, of pixels with three or four bytes."""
    with open(path, "rb") as file:
        data = file.read()
    try:
        place, parts = 8, []
        while place < len(data):
            size, kind = struct.unpack_from(">I4s", data, place)
            parts.append((kind, data[place + 8:place + 8 + size]))
            place += size + 12
        width, height, depth, colours, _, _, interlaced = struct.unpack(">IIBBBBB", parts[0][1])
        if data[:4] != b"\x89PNG" or depth != 8 or interlaced:
            raise ValueError
        channels = {2: 3, 6: 4}[colours]
        packed = zlib.decompress(b"".join(body for kind, body in parts if kind == b"IDAT"))
        pixels, above = bytearray(), bytes(width * channels)
        for start in range(0, height * (1 + width * channels), 1 + width * channels):
            above = unfiltered(packed[start], packed[start + 1:start + 1 + width * channels], above, channels)
            pixels += above
        return np.frombuffer(pixels, np.uint8).reshape(height, width, channels)
    except (ValueError, KeyError, IndexError, struct.error, zlib.error):
        raise BadFile(f"{path}: expected a PNG file with 8 bits a channel, RGB or RGBA, without interlacing") from None


class Trace:
    """The arrays of a file, checked."""

    def __init__(self, path):
        self.path = path
        try:
            with np.load(path) as file:
                self.arrays = {name: file[name] for name in file.files}
        except (ValueError, EOFError, zipfile.BadZipFile, AttributeError):
            raise BadFile(f"{path}: expected an .npz file without pickled objects") from None
        for name, shape in ARRAYS.items():
            array = self.arrays.get(name)
            if array is None or (shape is not None and array.shape[1:] != shape):
                raise BadFile(f"{path}: array {name}: expected one with rows of shape {shape}")
        self.draws = len(self["states"])
        for draw in range(self.draws):
            self.check(draw)

    def __getitem__(self, name):
        return self.arrays[name]

    def range(self, kind, draw):
        return slice(*(int(at) for at in self[f"draw_{kind}_start"][draw:draw + 2]))

    def state(self, draw):
        return dict(zip(self["state_names"].tolist(), self["states"][draw].tolist()))

    def texture(self, draw):
        """Rows of pixels with four bytes; row 0 has v = 0."""
        if not self.state(draw)["texture_enabled"]:
            return np.zeros((1, 1, 4), np.uint8)
        return self[f"texture_{self['texture_id'][draw]}_rgba"]

    def check(self, draw):
        """What the kernels rely on."""
        try:
            state, texture = self.state(draw), self.texture(draw)
            vertices = len(self["vertex_clip_xyzw"][self.range("vertex", draw)])
            triangles = self["triangles"][self.range("triangle", draw)]
        except (KeyError, ValueError, IndexError) as missing:
            raise BadFile(f"{self.path}: draw {draw}: has no {missing}, expected it") from None
        named = f"{self.path}: draw {draw}:"
        if triangles.size and not 0 <= triangles.min() <= triangles.max() < vertices:
            raise BadFile(f"{named} a triangle has vertex {triangles.max()}, expected 0 to {vertices - 1}")
        if any(size & size - 1 or size > 1 << 14 for size in texture.shape[:2]):
            raise BadFile(f"{named} a texture of {texture.shape[1]}x{texture.shape[0]} texels, expected powers of two")
        if state["stencil_test"]:
            raise BadFile(f"{named} uses the stencil, which is not built")
        if state["blend_enabled"] and SATURATE in (state["blend_src"], state["blend_dst"]):
            raise BadFile(f"{named} blends with factor {SATURATE} (saturate), which is not built")


class Machine:
    def __init__(self):
        self.context = cl.create_some_context(interactive=False)
        self.queue = cl.CommandQueue(self.context)
        self.program = cl.Program(self.context, KERNELS.read_text(encoding="utf-8")).build()

    def upload(self, values):
        flags = cl.mem_flags.READ_WRITE | cl.mem_flags.COPY_HOST_PTR
        # No buffer is empty.
        return cl.Buffer(self.context, flags, hostbuf=np.ascontiguousarray(values) if values.size else np.zeros(1))

    def room(self, size):
        return cl.Buffer(self.context, cl.mem_flags.READ_WRITE, max(size, 1))


def state_of(trace, draw, width, height):
    state, texture = trace.state(draw), trace.texture(draw)
    triangles = trace.range("triangle", draw)
    near, far = trace["viewport"][draw, 4:]
    return np.array((width, height, near, far, triangles.stop - triangles.start, state["depth_test"],
                     state["depth_writemask"] != 0, state["depth_func"], state["texture_enabled"],
                     texture.shape[1].bit_length() - 1, texture.shape[0].bit_length() - 1,
                     state["texture_magfilter"] == LINEAR, state["texture_addressU"] == CLAMP,
                     state["texture_envmode"] == MODULATE, state["blend_enabled"], state["blend_src"], state["blend_dst"]),
                    dtype=STATE)


def draw_trace(machine, trace, width, height):
    """The picture, rows from the top."""
    tiles = -(-width // TILE) * -(-height // TILE)
    picture = np.full((height, width, 4), (0, 0, 0, 255), np.uint8)
    colors = machine.upload(picture)
    depths = machine.upload(np.full(width * height, np.array((FARTHEST, 0), VISIBILITY)))
    seen = machine.room(width * height * VISIBILITY.itemsize)
    statuses = np.zeros(tiles, np.uint32)
    for draw in range(trace.draws):
        state = state_of(trace, draw, width, height)
        count = int(state["triangles"])
        if count == 0:
            continue
        vertices = trace.range("vertex", draw)
        inputs = [machine.upload(trace[name][vertices].astype("<f4")) for name in
                  ("vertex_clip_xyzw", "vertex_rgba", "vertex_uv")]
        triangles = machine.upload(trace["triangles"][trace.range("triangle", draw)].astype("<i4"))
        records, values = machine.room(count * TRIANGLE_BYTES), machine.room(count * ATTRIBUTE_BYTES)
        on_device, status = machine.upload(state), machine.upload(statuses)
        machine.program.set_up(machine.queue, (-(-count // GROUP) * GROUP,), (GROUP,), on_device, *inputs, triangles,
                               records, values)
        machine.program.draw(machine.queue, (GROUP * tiles,), (GROUP,), on_device, records, values,
                             machine.upload(trace.texture(draw)), machine.room(4 * count * tiles), seen, depths, colors,
                             status)
        cl.enqueue_copy(machine.queue, statuses, status)
        if statuses.any():
            sys.exit(f"trace.py: error: draw {draw}: tiles ended with status {statuses}")
    cl.enqueue_copy(machine.queue, picture, colors)
    return picture[::-1]  # row 0 of the target is the lowest


def size_of(text):
    numbers = [int(part) for part in text.split("x")]
    if len(numbers) not in (1, 2) or not all(1 <= n <= 4096 for n in numbers):
        raise ValueError
    return numbers[0], numbers[-1]


def main():
    parser = argparse.ArgumentParser(prog="trace.py", description=__doc__,
                                     epilog="exit code 1: pixels differ; 3: a file is not as expected")
    parser.add_argument("trace", metavar="TRACE.npz")
    parser.add_argument("picture", metavar="PICTURE.png", help="is written")
    parser.add_argument("--size", metavar="N or WxH", type=size_of, default=(128, 128), help="of the picture (128)")
    parser.add_argument("--reference", metavar="FILE.png", help="a picture to compare with, in all its channels")
    options = parser.parse_args()
    trace = Trace(options.trace)
    reference = read_png(options.reference) if options.reference else None
    width, height = options.size
    if reference is not None and reference.shape[:2] != (height, width):
        raise BadFile(f"{options.reference}: {reference.shape[1]}x{reference.shape[0]} pixels, expected {width}x{height}")
    picture = draw_trace(Machine(), trace, width, height)
    write_png(options.picture, picture)
    said = f"{options.trace}: {trace.draws} draws, {len(trace['triangles'])} triangles, {width}x{height} pixels"
    if reference is None:
        print(said)
        return 0
    differ = int((picture[:, :, :reference.shape[2]] != reference).any(axis=2).sum())
    print(f"{said}, {differ} differ")
    return 1 if differ else 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except (BadFile, OSError) as problem:
        print(f"trace.py: error: {problem}", file=sys.stderr)
        sys.exit(3)
