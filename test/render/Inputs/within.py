#!/usr/bin/env python3
"""Whether two pictures (.pfm) differ by no more than MOST in any channel.

usage: within.py A.pfm B.pfm MOST
"""

import array
import sys


def read(file):
    with open(file, "rb") as f:
        lines = [f.readline() for _ in range(3)]
        return lines, array.array("f", f.read())


(head, a), (other, b) = read(sys.argv[1]), read(sys.argv[2])
if head != other or len(a) != len(b):
    sys.exit(f"{head} and {other}, expected pictures of one kind")
worst = max(abs(x - y) for x, y in zip(a, b))
print(f"largest difference {worst:.3g}")
if not worst <= float(sys.argv[3]):
    sys.exit(f"expected at most {sys.argv[3]}")
