#!/usr/bin/env python3
"""Writes a PLY of floats as one whose x, y and z are doubles, moved by an offset.

usage: far_doubles.py FROM.ply TO.ply DX DY DZ
"""

import struct
import sys

source, target = sys.argv[1:3]
offset = [float(v) for v in sys.argv[3:6]]
header, body = open(source, "rb").read().split(b"end_header\n", 1)
stride = 4 * header.count(b"property float ")
for axis in (b"x", b"y", b"z"):
    header = header.replace(b"property float %s\n" % axis, b"property double %s\n" % axis)
with open(target, "wb") as out:
    out.write(header + b"end_header\n")
    for row in range(0, len(body), stride):
        near = struct.unpack_from("<3f", body, row)
        out.write(struct.pack("<3d", *(n + d for n, d in zip(near, offset))))
        out.write(body[row + 12 : row + stride])
