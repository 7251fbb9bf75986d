#!/usr/bin/env python3
"""Writes a mask beside each picture, whose left half is black: those pixels do not count.

usage: half_masks.py PICTURES MASKS WIDTH HEIGHT
"""

import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "Inputs"))
import png_file

pictures, masks = sys.argv[1:3]
width, height = int(sys.argv[3]), int(sys.argv[4])
row = bytes(width // 2) + b"\xff" * (width - width // 2)
os.makedirs(masks)
for name in os.listdir(pictures):
    png_file.write(os.path.join(masks, name), [row] * height, 1)
