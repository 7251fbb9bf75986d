#!/usr/bin/env python3
"""The depths that splat render --depth wrote.

usage: mean_depth.py FILE.npz
Prints the array's shapes, and between what the depth of a pixel's mean lies (the sum over alpha) where
alpha is at least 1/4.
"""

import io
import struct
import sys
import zipfile


def array(archive, name):
    with io.BytesIO(archive.read(name + ".npy")) as f:
        assert f.read(8) == b"\x93NUMPY\x01\x00"
        header = f.read(struct.unpack("<H", f.read(2))[0]).decode()
        assert "'<f4'" in header, header
        shape = [int(n) for n in header.split("(")[1].split(")")[0].split(",") if n.strip()]
        return shape, struct.unpack(f"<{shape[0] * shape[1]}f", f.read())


with zipfile.ZipFile(sys.argv[1]) as archive:
    shape, depth = array(archive, "depth")
    alpha_shape, alpha = array(archive, "alpha")
means = [d / a for d, a in zip(depth, alpha) if a >= 0.25]
print(f"depth {shape} alpha {alpha_shape}: {len(means)} pixels from {min(means):.5f} to {max(means):.5f}")
