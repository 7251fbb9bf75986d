#!/usr/bin/env python3
"""Prints the linear values of half steps of a channel of sRGB of 8 bits, n / 510 for n from 0, as OpenCL C's floats."""


def linear(s):
    return s / 12.92 if s <= 0.04045 else ((s + 0.055) / 1.055) ** 2.4


for n in range(511):
    print(f"{linear(n / 510):.9e}f,")
