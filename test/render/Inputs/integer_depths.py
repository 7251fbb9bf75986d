#!/usr/bin/env python3
"""Checks that a mesh's depths are those of a depth buffer of integers.

usage: integer_depths.py BITS NEAR VISIBLE.npz
The file is of splat render --visible, with fp32 numbers.
"""

import array
import sys
import zipfile


def values(path, name, kind="f"):
    data = zipfile.ZipFile(path).read(name + ".npy")
    return array.array(kind, data[10 + int.from_bytes(data[8:10], "little"):])


bits, near, path = int(sys.argv[1]), float(sys.argv[2]), sys.argv[3]
places = [near / depth * (2**bits - 1) for depth, triangle in zip(values(path, "depth"), values(path, "triangle", "i"))
          if triangle >= 0]
wrong = sum(abs(place - round(place)) > 0.02 or not 0 <= place < 2**bits for place in places)
print(f"{len(places)} pixels show the mesh at {len(set(map(round, places)))} depths; {wrong} wrong")
