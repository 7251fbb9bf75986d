#!/usr/bin/env python3
"""Counts the instructions of every reader on one size and on ten times the size, and says which takes more than LIMIT
times as many: what is linear takes ten times, or less where something is done once; what looks through everything for
each thing takes a hundred times.

usage: linear.py READER_WORK FOLDER LIMIT"""
import os
import re
import subprocess
import sys

program, folder, limit = sys.argv[1], sys.argv[2], float(sys.argv[3])
out = os.path.join(folder, "callgrind.out")
# Collects within the call alone, and writes a file of its own at each call's end.
said = subprocess.run(
    ["valgrind", "--tool=callgrind", "--toggle-collect=readOnce*", "--dump-after=readOnce*", f"--callgrind-out-file={out}", program],
    check=True, capture_output=True, text=True).stdout.split("\n")
calls = [line.split() for line in said if line]


def instructions(number):
    with open(f"{out}.{number}") as dump:
        return int(re.search(r"^(?:summary|totals): (\d+)", dump.read(), re.M).group(1))


slow = []
for place in range(0, len(calls), 2):
    (name, small), (_, large) = calls[place], calls[place + 1]
    few, many = instructions(place + 1), instructions(place + 2)
    print(f"{name}: {few} instructions for {small}, {many} for {large}, {many / few:.1f} times")
    if not few < many <= limit * few:
        slow.append(name)
print(f"{len(calls) // 2} readers, not linear: {' '.join(slow) if slow else 'none'}")
