#!/usr/bin/env python3
"""Whether the fp32 arrays of two .npz files are close.

usage: close_arrays.py A.npz B.npz BOUND
Each array may differ by BOUND, relative, in the L2 norm.
"""

import math
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "Inputs"))

import npz_file

first, second = map(npz_file.arrays, sys.argv[1:3])
assert first and first.keys() == second.keys(), (list(first), list(second))
other = 0
for name, (shape, a) in first.items():
    shape_of_b, b = second[name]
    assert shape == shape_of_b, name
    error = math.dist(a, b) / (math.hypot(*a) or 1)
    if not error <= float(sys.argv[3]):
        sys.exit(f"{name}: {error:.2e}, expected at most {sys.argv[3]}")
    other += a != b
print(f"close: all {len(first)} arrays, {other} with other bits")
