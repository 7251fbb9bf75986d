#!/usr/bin/env python3
"""Writes a PLY with comments after its first line.

usage: tagged.py IN.ply OUT.ply COMMENT..."""
import sys

with open(sys.argv[1], "rb") as file:
    first, rest = file.read().split(b"\n", 1)
with open(sys.argv[2], "wb") as file:
    file.write(first + b"\n" + b"".join(b"comment " + c.encode() + b"\n" for c in sys.argv[3:]) + rest)
