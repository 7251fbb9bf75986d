"""Checks that each share of the table on the terminal is that of the report's reason of the same name."""
import json
import sys

lines = open(sys.argv[1]).read().splitlines()
report = json.load(open(sys.argv[2]))["time"]
head = next(n for n, line in enumerate(lines) if line.startswith("stage ") and "|" in line)
reasons = lines[head].split("|")[1].split()
assert reasons.pop() == "other" and {"issue", "memory"} <= set(reasons), reasons
stages = {stage["name"]: stage["time"] for stage in report["stages"] if "time" in stage} | {"frame": report["sum"]}
seen = 0
for line in lines[head + 1:]:
    name = line[:18].strip()
    if name not in stages or "|" not in line:
        continue
    time = stages[name]
    for reason, shown in zip(reasons, line.split("|")[1].split()):
        share = 100 * sum(core[reason] for core in time["cores"]) / (time["cycles"] * len(time["cores"]))
        assert abs(share - float(shown)) <= 0.051, (name, reason, share, shown)
        seen += 1
assert seen >= 7 * len(stages), seen
