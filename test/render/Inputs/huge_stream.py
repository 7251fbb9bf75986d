#!/usr/bin/env python3
"""Writes an .spz whose header says one Gaussian and whose stream has 2^29 bytes more.

usage: huge_stream.py OUT.spz"""
import struct
import sys
import zlib

packer = zlib.compressobj(1, zlib.DEFLATED, 31)
with open(sys.argv[1], "wb") as file:
    file.write(packer.compress(struct.pack("<IIIBBBB", 0x5053474e, 3, 1, 0, 12, 0, 0) + bytes(20)))
    zeros = bytes(1 << 24)
    for _ in range(32):
        file.write(packer.compress(zeros))
    file.write(packer.flush())
