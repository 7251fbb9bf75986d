"""usage: kanata.py LOG STATS CORE: checks a log of --pipeline that has a whole run of a core: its stages are in order,
and each reason has the cycles that the run's report gives it."""
import collections
import json
import os
import sys

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "..", "intrinsics", "generate"))
import clock

log, stats, core = open(sys.argv[1]), json.load(open(sys.argv[2])), int(sys.argv[3])
run = stats["runs"][0]
assert log.readline() == "Kanata\t0004\n"
now, open_stages, seen, retired = None, {}, set(), []
spent = collections.Counter()
for line in log:
    kind, *rest = line.rstrip("\n").split("\t")
    if kind == "C=":
        assert now is None
        now = int(rest[0])
    elif kind == "C":
        assert int(rest[0]) > 0
        now += int(rest[0])
    elif kind == "I":
        assert int(rest[0]) == len(seen)
        seen.add(rest[0])
    elif kind == "S":
        assert rest[0] in seen
        open_stages[rest[0], rest[2]] = now
    elif kind == "E":
        spent[rest[2]] += now - open_stages.pop((rest[0], rest[2]))
    elif kind == "R":
        assert not any(key[0] == rest[0] for key in open_stages), line
        assert int(rest[1]) == len(retired)
        retired.append(rest[0])
    else:
        assert kind == "L", line
assert set(retired) == seen and not open_stages
assert len(seen) == run["cores"][core]["warp_instructions"]
time = run["time"]["cores"][core]
for reason in clock.reasons("cores"):
    if reason not in ("start", "ended", "barrier"):
        assert spent[reason] == time[reason], (reason, spent[reason], time[reason])
assert spent["execute"] > 0
