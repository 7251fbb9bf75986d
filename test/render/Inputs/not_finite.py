#!/usr/bin/env python3
"""Writes a scene in which Gaussians hold a NaN in their last property, and the scene without these.

usage: not_finite.py IN.ply BAD.ply OTHERS.ply INDEX..."""
import struct
import sys

source, bad, others = sys.argv[1:4]
chosen = {int(word) for word in sys.argv[4:]}
with open(source, "rb") as file:
    content = file.read()
end = content.index(b"end_header\n") + len(b"end_header\n")
header, body = content[:end], content[end:]
count = int(header.split(b"element vertex ")[1].split()[0])
size = len(body) // count
rows = [body[i * size:(i + 1) * size] for i in range(count)]
with open(bad, "wb") as file:
    file.write(header + b"".join(r[:-4] + struct.pack("<f", float("nan")) if i in chosen else r for i, r in enumerate(rows)))
with open(others, "wb") as file:
    left = [r for i, r in enumerate(rows) if i not in chosen]
    file.write(header.replace(b"vertex %d" % count, b"vertex %d" % len(left)) + b"".join(left))
