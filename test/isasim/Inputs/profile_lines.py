"""usage: profile_lines.py PROFILE STATS: checks that the lines of a profile without the clock are those that the
load/store unit of a run with the clock was asked for, and prints how many an access took at most."""
import json
import sys

profile, stats = (json.load(open(name)) for name in sys.argv[1:])
instructions = [i for p in profile["programs"] for i in p["instructions"]]
lines = sum(i["lines"] for i in instructions)
asked = next(a["count"] for a in stats["runs"][0]["time"]["activities"]
             if (a["unit"], a["event"]) == ("lsu", "lines requested"))
assert lines == asked, (lines, asked)
print(f"{lines} lines, at most {max(i['lines'] / i['accesses'] for i in instructions if i['accesses']):g} an access")
