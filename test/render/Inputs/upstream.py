#!/usr/bin/env python3
"""Writes the gradients of a loss, of both signs, as splat gradients reads them.

usage: upstream.py OUT.npz WIDTH HEIGHT
"""

import math
import struct
import sys
import zipfile


def npy(shape, values):
    header = f"{{'descr': '<f4', 'fortran_order': False, 'shape': {shape}, }}"
    header += " " * (63 - (10 + len(header)) % 64) + "\n"
    return b"\x93NUMPY\x01\x00" + struct.pack("<H", len(header)) + header.encode() + struct.pack(f"<{len(values)}f", *values)


out, width, height = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
pixels = width * height
with zipfile.ZipFile(out, "w") as file:
    file.writestr("in_v_render.npy", npy((height, width, 3), [math.sin(1.3 * i) for i in range(3 * pixels)]))
    file.writestr("in_v_alpha.npy", npy((height, width), [math.cos(0.7 * i) for i in range(pixels)]))
