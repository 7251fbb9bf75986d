#!/usr/bin/env python3
"""Prints a counter of the whole picture, or the comparison of two files' counters.

usage: counter.py NAME A.json [B.json]
"""

import json
import sys

values = [json.load(open(file))["total"]["counters"][sys.argv[1]] for file in sys.argv[2:]]
if len(values) == 1:
    print(f"{sys.argv[1]} {values[0]}")
else:
    print(f"{sys.argv[1]} {'equal' if values[0] == values[1] else 'more' if values[1] > values[0] else 'less'}")
