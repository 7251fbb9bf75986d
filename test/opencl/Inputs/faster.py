"""Whether the time report FILE2 has FACTOR times fewer cycles than FILE1: faster.py FILE1 FILE2 FACTOR."""

import re
import sys


def cycles(path):
    with open(path, encoding="utf-8") as file:
        return int(re.search(r"^cycles +([0-9]+)", file.read(), re.MULTILINE).group(1))


first, second = map(cycles, sys.argv[1:3])
if first < float(sys.argv[3]) * second:
    sys.exit(f"{first} and {second} cycles, expected {sys.argv[3]} times fewer")
