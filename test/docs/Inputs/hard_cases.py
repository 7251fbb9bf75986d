"""usage: hard_cases.py LIST PAGE: checks that PAGE says how many of the cases in LIST (splat-hard-cases --list) it has."""

import re
import sys

with open(sys.argv[1], encoding="utf-8") as file:
    cases = {line.split()[0] for line in file}
with open(sys.argv[2], encoding="utf-8") as file:
    text = file.read()
rows = set(re.findall(r"^\| ([\w.-]+) \|", text, re.MULTILINE))
there = len(cases & rows)
said = re.search(r"have (\d+) of the (\d+) cases .*? other (\d+) cases", " ".join(text.split()))
if said is None or [int(n) for n in said.groups()] != [there, len(cases), len(cases) - there]:
    sys.exit(f"{sys.argv[2]} has {there} of {len(cases)} cases, and says {said and said.groups()}")
