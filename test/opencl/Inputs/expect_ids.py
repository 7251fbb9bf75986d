"""Compares the ids that any-size.cl notes with those of the shape: expect_ids.py FILE LOCAL GLOBAL, as vorion-sim takes them."""

import array
import itertools
import sys

local, range_ = (tuple(map(int, text.split(","))) for text in sys.argv[2:4])
with open(sys.argv[1], "rb") as file:
    found = array.array("I", file.read())
places = itertools.product(*(range(size) for size in reversed(range_)))
expected = [x % local[0] | y % local[1] << 10 | z % local[2] << 20 for z, y, x in places]
if len(found) != len(expected):
    sys.exit(f"{len(found)} words, expected {len(expected)}")
wrong = [place for place, pair in enumerate(zip(found, expected)) if pair[0] != pair[1]]
if wrong:
    sys.exit(f"{len(wrong)} of {len(expected)} work-items differ, the first is {wrong[0]}")
