#!/usr/bin/env python3
"""Counts the instructions of every reader on one size and on ten times the size, and says which takes more than LIMIT
times as many: what is linear takes ten times, or less where something is done once; what looks through everything for
each thing takes a hundred times.

usage: linear.py READER_WORK FOLDER LIMIT, which leaves its files in FOLDER"""
import os
import re
import subprocess
import sys

program, folder, limit = sys.argv[1], sys.argv[2], float(sys.argv[3])
# valgrind cannot read clang's debug information; names are enough.
bare, out = os.path.join(folder, "reader-work"), os.path.join(folder, "callgrind.out")
subprocess.run(["llvm-strip", "--strip-debug", "-o", bare, program], check=True)
said = subprocess.run(["valgrind", "--tool=callgrind", "--toggle-collect=bool readOnce*", f"--callgrind-out-file={out}", bare],
                      check=True, capture_output=True, text=True).stdout
calls = [line.split() for line in said.splitlines()]
annotated = subprocess.run(["callgrind_annotate", "--inclusive=yes", "--threshold=100", out], check=True, capture_output=True,
                           text=True).stdout
counts = {int(number): int(count.replace(",", ""))
          for count, number in re.findall(r"^ *([\d,]+) .*?bool readOnce<(\d+)ul>", annotated, re.M)}

slow = []
for place in range(0, len(calls), 2):
    (name, small), (_, large) = calls[place], calls[place + 1]
    few, many = counts[place], counts[place + 1]
    print(f"{name}: {few} instructions for {small}, {many} for {large}, {many / few:.1f} times")
    if not few < many <= limit * few:
        slow.append(name)
print(f"{len(calls) // 2} readers, not linear: {' '.join(slow) if slow else 'none'}")
