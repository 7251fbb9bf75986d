#!/usr/bin/env python3
"""OpenEXR by its document, not by its library: scan lines without compression or with ZIP.

usage: exr.py same PICTURE.exr PICTURE.npz [half]   whether both hold the same values, rounded to half;
                                                    the values may be depths
       exr.py write PICTURE.exr PICTURE.npz         a window of 5x4 pixels around the data's 3x2, halves and floats mixed
"""

import struct
import sys
import zlib

import numpy as np

TYPES = {1: np.dtype("<f2"), 2: np.dtype("<f4")}


def text(data, at):
    end = data.index(b"\0", at)
    return data[at:end].decode(), end + 1


def header(data):
    assert data[:4] == b"\x76\x2f\x31\x01" and struct.unpack_from("<I", data, 4)[0] == 2, "no single scan-line file"
    at, found = 8, {}
    while data[at]:
        name, at = text(data, at)
        _, at = text(data, at)
        size, = struct.unpack_from("<i", data, at)
        found[name] = data[at + 4:at + 4 + size]
        at += 4 + size
    return found, at + 1


def channels(body):
    at = 0
    while body[at]:
        name, at = text(body, at)
        yield name, TYPES[struct.unpack_from("<i", body, at)[0]]
        at += 16


def unzipped(block):
    """ZIP's predictor and the two halves of its bytes."""
    data = np.cumsum(np.frombuffer(zlib.decompress(block), "u1").astype(np.int64) - 128)
    data = ((data + 128) % 256).astype("u1")
    half = (len(data) + 1) // 2
    out = np.empty_like(data)
    out[0::2], out[1::2] = data[:half], data[half:]
    return out.tobytes()


def read(path):
    with open(path, "rb") as f:
        data = f.read()
    found, at = header(data)
    lines = {0: 1, 3: 16}[found["compression"][0]]
    left, top, right, bottom = struct.unpack("<4i", found["dataWindow"])
    width, height = right - left + 1, bottom - top + 1
    kinds = list(channels(found["channels"]))
    planes = {name: np.empty((height, width), kind) for name, kind in kinds}
    row = width * sum(kind.itemsize for _, kind in kinds)
    for n, (start,) in enumerate(struct.iter_unpack("<Q", data[at:at + 8 * -(-height // lines)])):
        y, size = struct.unpack_from("<ii", data, start)
        y -= top
        block = data[start + 8:start + 8 + size]
        rows = min(lines, height - y)
        if size < rows * row:
            block = unzipped(block)
        offset = 0
        for line in range(y, y + rows):
            for name, kind in kinds:
                planes[name][line] = np.frombuffer(block, kind, width, offset)
                offset += width * kind.itemsize
    return planes


def same(exr, npz, half):
    planes, wanted = read(exr), np.load(npz)
    kind = np.dtype("<f2" if half else "<f4")
    own = [("Z", wanted["depth"])] if "depth" in wanted else [(n, wanted["render"][..., k]) for k, n in enumerate("RGB")]
    for name, plane in (*own, ("A", wanted["alpha"])):
        assert planes[name].dtype == kind, planes[name].dtype
        with np.errstate(over="ignore"):
            assert np.array_equal(planes[name], plane.astype(kind)), name
    print(f"{len(planes)} channels of {kind.name} agree")


def write(exr, npz):
    def attribute(name, kind, body):
        return f"{name}\0{kind}\0".encode() + struct.pack("<i", len(body)) + body

    r = np.random.default_rng(1)
    kinds = {"A": "<f2", "B": "<f4", "G": "<f2", "R": "<f4"}
    planes = {n: r.uniform(-1, 3, (2, 3)).astype(k) for n, k in kinds.items()}
    listed = b"".join(n.encode() + b"\0" + struct.pack("<iB3xii", {"<f2": 1, "<f4": 2}[k], 0, 1, 1)
                      for n, k in kinds.items()) + b"\0"
    head = b"\x76\x2f\x31\x01" + struct.pack("<I", 2)
    head += attribute("channels", "chlist", listed) + attribute("compression", "compression", b"\0")
    head += attribute("dataWindow", "box2i", struct.pack("<4i", 11, 21, 13, 22))
    head += attribute("displayWindow", "box2i", struct.pack("<4i", 10, 20, 14, 23))
    head += attribute("lineOrder", "lineOrder", b"\0") + attribute("pixelAspectRatio", "float", struct.pack("<f", 1))
    head += attribute("screenWindowCenter", "v2f", struct.pack("<2f", 0, 0))
    head += attribute("screenWindowWidth", "float", struct.pack("<f", 1)) + b"\0"
    rows = [b"".join(planes[n][y].tobytes() for n in sorted(kinds)) for y in range(2)]
    first = len(head) + 16
    with open(exr, "wb") as f:
        f.write(head + struct.pack("<2Q", first, first + 8 + len(rows[0])))
        for y, row in enumerate(rows):
            f.write(struct.pack("<ii", 21 + y, len(row)) + row)
    whole = {n: np.pad(p.astype("<f4"), 1) for n, p in planes.items()}
    np.savez(npz, render=np.stack([whole[n] for n in "RGB"], axis=2), alpha=whole["A"])


if sys.argv[1] == "same":
    same(sys.argv[2], sys.argv[3], sys.argv[4:] == ["half"])
else:
    write(sys.argv[2], sys.argv[3])
