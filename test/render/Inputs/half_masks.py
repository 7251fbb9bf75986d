#!/usr/bin/env python3
"""Writes a mask beside each picture, whose left half is black: those pixels do not count.

usage: half_masks.py PICTURES MASKS WIDTH HEIGHT
"""

import os
import struct
import sys
import zlib

pictures, masks = sys.argv[1:3]
width, height = int(sys.argv[3]), int(sys.argv[4])


def chunk(kind, body):
    return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))


row = b"\0" + bytes(width // 2) + b"\xff" * (width - width // 2)
png = (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)) +
       chunk(b"IDAT", zlib.compress(row * height)) + chunk(b"IEND", b""))
os.makedirs(masks)
for name in os.listdir(pictures):
    with open(os.path.join(masks, name), "wb") as f:
        f.write(png)
