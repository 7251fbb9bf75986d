"""usage: cycle_profile.py PROFILE STATS: checks a profile of cycles against the time of the same run: places add up to
the total, which has all cycles of all cores, and each reason to its share."""
import json
import re
import sys

text, stats = open(sys.argv[1]).read(), json.load(open(sys.argv[2]))
time = stats["runs"][0]["time"]
reasons = next(line for line in text.splitlines() if "cycles" in line and "issue" in line).split()[2:]
columns = r" +(\d+) +([\d.]+)((?: +(?:[\d.]+|-)){%d})  (.*)" % len(reasons)
rows = [re.match(columns, line) for line in text.splitlines()]
total = next(r for r in rows if r and r[4] == "total")
assert int(total[1]) == time["cycles"] * len(time["cores"])
for reason, share in zip(reasons, total[3].split(), strict=True):
    exact = 100 * sum(core[reason] for core in time["cores"]) / int(total[1])
    assert abs(float(share) - exact) < 0.006, (reason, share, exact)
single = next(n for n, line in enumerate(text.splitlines()) if "instructions of" in line)
places = [r for r in rows[:single] if r and (re.match(r" *\d+  |no instruction", r[4]) or re.fullmatch(r"[\w.$]+", r[4]))]
places.remove(total)
assert sum(int(r[1]) for r in places) == int(total[1]), [r[0] for r in places]
