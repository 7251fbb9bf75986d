"""usage: time_report_doc.py DOCUMENT STATS: every figure of a run's time report is in a table of the document, under the
unit that has it, and no other is."""
import json
import re
import sys

document = open(sys.argv[1]).read()
time = json.load(open(sys.argv[2]))["runs"][0]["time"]


def rows(heading):
    """The names in the first column of the tables below a heading."""
    part = re.search(rf"^## {heading}\n(.*?)(?=^## |\Z)", document, re.M | re.S)[1]
    return part, [name for line in part.splitlines() if line.startswith("| `")
                  for name in re.findall(r"`(\w+)`", line.split("|")[1])]


def same(told, counted, what):
    assert set(told) == set(counted), (what, set(told) ^ set(counted))


groups = {"cores", "rasterizers", "pixel_units", "l2", "llc", "dram", "activities"}
same(rows("The report")[1], set(time) - groups, "the report")
same(rows("Caches")[1], time["llc"], "caches")
same(rows("DRAM")[1], time["dram"], "DRAM")
part, names = rows("Cycles by reason")
for unit in ("cores", "rasterizers", "pixel_units"):
    assert unit in names
    for name in time[unit][0]:
        assert f"`{name}`" in part, (unit, name)
units = {"cores", "rasterizers", "pixel_units"}
assert set(names) - units <= {name for unit in units for name in time[unit][0]}, names
activities = rows("Activities")[0]
for activity in time["activities"]:
    assert f"`{activity['unit']}`" in activities, activity
    if "instructions" not in activity["unit"]:
        assert f"`{activity['event']}`" in activities, activity
