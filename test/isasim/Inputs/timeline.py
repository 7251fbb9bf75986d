"""usage: timeline.py FILE: checks a timeline and prints its rows."""
import json
import sys

document = json.load(open(sys.argv[1]))
assert document["otherData"]["format"] == "vorion-timeline 1"
names, processes, slices = {}, {}, {}
for event in document["traceEvents"]:
    if event["ph"] == "M":
        if event["name"] == "process_name":
            processes[event["pid"]] = event["args"]["name"]
        else:
            names[event["pid"], event["tid"]] = event["args"]["name"]
        continue
    assert event["ph"] == "X" and event["dur"] > 0, event
    row = slices.setdefault((event["pid"], event["tid"]), [])
    assert not row or row[-1][1] <= event["ts"], f"slices overlap: {event}"
    row.append((event["name"], event["ts"] + event["dur"]))
for process, name in sorted(processes.items(), key=lambda p: p[1]):
    print(f"{name}: {sum(pid == process for pid, tid in names)} rows")
for key in sorted(slices):
    print(f"{names[key]}: {', '.join(name for name, end in slices[key])}")
