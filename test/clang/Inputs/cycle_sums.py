#!/usr/bin/env python3
"""cycle_sums.py PROFILE LISTING: whether the listing of vorion-objdump --profile has each instruction of the profile once."""

import json
import re
import sys

with open(sys.argv[1], encoding="utf-8") as file:
    wanted = {each["pc"]: (each["cycles"], each["executed"])
              for each in json.load(file)["programs"][0]["instructions"]}
found, doubled = {}, 0
with open(sys.argv[2], encoding="utf-8") as file:
    for line in file:
        match = re.match(r" *(\d+) +[\d.]+ +(\d+)  \S* *([0-9a-f]{8}): ", line)
        if match:
            pc = int(match[3], 16)
            doubled += pc in found
            found[pc] = int(match[1]), int(match[2])
same = found == wanted and not doubled
print(f"{len(found)} instructions, cycles and counts " + ("as in the profile" if same else "not as in the profile"))
