#!/usr/bin/env python3
"""Changes a checkpoint of `splat train`, and makes its checksum right again.

usage: checkpoint.py FROM TO nan|types|huge
nan: the first number becomes a NaN; types: the iteration becomes a text; huge: the header speaks of as many Gaussians
as the file has bytes
"""

import json
import struct
import sys


def fnv1a64(data):
    value = 0xCBF29CE484222325
    for byte in data:
        value = (value ^ byte) * 0x100000001B3 & 0xFFFFFFFFFFFFFFFF
    return f"{value:016x}"


source, target, change = sys.argv[1:]
with open(source, "rb") as f:
    first, header, body = f.read().split(b"\n", 2)
says = json.loads(header)
if change == "nan":
    body = struct.pack("<f", float("nan")) + body[4:]
elif change == "types":
    says["iteration"] = "six"
else:
    says["gaussians"] = says["iteration"] = len(body)
data = json.dumps(says).encode() + b"\n" + body
with open(target, "wb") as f:
    f.write(b" ".join(first.split()[:2] + [fnv1a64(data).encode()]) + b"\n" + data)
