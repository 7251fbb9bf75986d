"""Writes triangle tiles in the form of docs/rtl.md, "Triangles of others", covered as Python's integers say.

usage: triangles.py FILE [CHANGE]
CHANGE: what is wrong with the file, a key of CHANGES.
"""

import io
import random
import struct
import sys
import zipfile

SIDE = 32
TYPES = {"<i4": "i", "<i2": "h", "|u1": "B", "<f4": "f"}


def array(kind, shape, values):
    """A .npy file."""
    header = f"{{'descr': '{kind}', 'fortran_order': False, 'shape': {shape}, }}".ljust(117) + "\n"
    body = struct.pack(f"<{len(values)}{TYPES[kind]}", *values)
    return b"\x93NUMPY\1\0" + struct.pack("<H", len(header)) + header.encode() + body


def texts(values):
    header = f"{{'descr': '<U8', 'fortran_order': False, 'shape': ({len(values)},), }}".ljust(117) + "\n"
    body = "".join(v.ljust(8, "\0") for v in values).encode("utf-32-le")
    return b"\x93NUMPY\1\0" + struct.pack("<H", len(header)) + header.encode() + body


def triangles(engine, count):
    """Edges a, b, c in 16.16 and a window each: triangles of all sizes, and windows that cut some of them."""
    for number in range(count):
        reach = 2 ** engine.uniform(1, 9)
        middle = [engine.uniform(0, 400) for _ in "xy"]
        corners = [[m + engine.uniform(-reach, reach) for m in middle] for _ in range(3)]
        edges = []
        for n in range(3):
            (x0, y0), (x1, y1) = corners[n], corners[(n + 1) % 3]
            a, b = y0 - y1, x1 - x0
            edges.append([a, b, -a * x0 - b * y0])
        if edges[0][0] * edges[1][1] - edges[0][1] * edges[1][0] < 0:
            edges = [[-v for v in e] for e in edges]
        largest = max(abs(v) for e in edges for v in e[:2])
        edges = [[int(v / largest * 65536) for v in e] for e in edges]
        window = [0, 400, 0, 400] if number % 3 else sorted(engine.sample(range(400), 2)) + sorted(
            engine.sample(range(400), 2))
        yield edges, window


def records(engine, edges, window):
    """The tiles of some places, each with the edges at its first pixel and the pixels that are covered."""
    for _ in range(3):
        tile = [engine.randrange(13) * SIDE for _ in "xy"]
        corner = [a * tile[0] + b * tile[1] + c for a, b, c in edges]
        bits = bytearray()
        for y in range(SIDE):
            row = sum(1 << x for x in range(SIDE)
                      if all(e + a * x + b * y >= 0 for e, (a, b, _) in zip(corner, edges))
                      and window[0] <= tile[0] + x < window[1] and window[2] <= tile[1] + y < window[3])
            bits += row.to_bytes(SIDE // 8, "little")
        yield tile, corner, bits


def all_arrays(count):
    engine = random.Random(66)
    kinds, all_edges, windows = [], [], []
    of, tiles, corners, cover = [], [], [], bytearray()
    for number, (edges, window) in enumerate(triangles(engine, count)):
        kinds.append(number % 2)
        all_edges += [v for e in edges for v in e]
        windows += window
        for tile, corner, bits in records(engine, edges, window):
            of.append(number)
            tiles += tile
            corners += corner
            cover += bits
    found = len(of)
    return {
        "kind_names": texts(["even", "odd"]),
        "tri_kind": array("|u1", (count,), kinds),
        "tri_edge_abc": array("<i4", (count, 3, 3), all_edges),
        "tri_window_x0x1y0y1": array("<i2", (count, 4), windows),
        "rec_tri": array("<i2", (found,), of),
        "rec_tile_xy": array("<i2", (found, 2), tiles),
        "rec_edge_at_tile": array("<i4", (found, 3), corners),
        "rec_cover_bits": array("|u1", (found, SIDE, SIDE // 8), cover),
        "rec_cycle_first_last_idle": array("<i2", (found, 3), [9] * 3 * found),
        "more": array("<f4", (2,), [1, 2]),
    }


def without_last(name):
    def change(arrays):
        arrays[name] = arrays[name][:-1]
    return change


def replaced(name, *new):
    def change(arrays):
        arrays[name] = array(*new)
    return change


CHANGES = {
    "missing": lambda arrays: arrays.pop("rec_tri"),
    "short": without_last("rec_cover_bits"),
    "floats": replaced("rec_tri", "<f4", (1,), [0]),
    "rows": replaced("rec_tri", "<i2", (1,), [0]),
    "shape": replaced("rec_tile_xy", "<i2", (1, 3), [0, 0, 0]),
    "triangle": lambda arrays: arrays.update(rec_tri=arrays["rec_tri"][:-2] + b"\x77\x77"),
    "tile": lambda arrays: arrays.update(rec_tile_xy=arrays["rec_tile_xy"][:-2] + b"\xff\xff"),
    "square": replaced("rec_cover_bits", "|u1", (1, 32, 3), [0] * 96),
    "bit": lambda arrays: arrays.update(rec_cover_bits=arrays["rec_cover_bits"][:-1] + bytes(
        [arrays["rec_cover_bits"][-1] ^ 0x80])),
    "huge": replaced("rec_tri", "<i2", (2 ** 40,), []),
}


def main():
    path, *change = sys.argv[1:]
    arrays = all_arrays(120)
    for name in change:
        CHANGES[name](arrays)
    archive = io.BytesIO()
    with zipfile.ZipFile(archive, "w", zipfile.ZIP_DEFLATED) as file:
        for name, body in arrays.items():
            file.writestr(name + ".npy", body)
    with open(path, "wb") as file:
        file.write(archive.getvalue())


if __name__ == "__main__":
    main()
