#!/usr/bin/env python3
"""The depths that splat render --depth wrote.

usage: mean_depth.py FILE.npz
Prints the array's shapes, and between what the depth of a pixel's mean lies (the sum over alpha) where
alpha is at least 1/4.
"""

import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "Inputs"))

import npz_file

held = npz_file.arrays(sys.argv[1])
(shape, depth), (alpha_shape, alpha) = held["depth"], held["alpha"]
means = [d / a for d, a in zip(depth, alpha) if a >= 0.25]
print(f"depth {shape} alpha {alpha_shape}: {len(means)} pixels from {min(means):.5f} to {max(means):.5f}")
