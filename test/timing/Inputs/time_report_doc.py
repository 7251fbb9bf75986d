"""usage: time_report_doc.py DOCS STATS: every figure of a run's time report is in a table of DOCS/time-report.md or
DOCS/tables/clock-reasons.md, under the unit that has it, and no other is."""
import json
import re
import sys

document = open(f"{sys.argv[1]}/time-report.md").read()
reasons = open(f"{sys.argv[1]}/tables/clock-reasons.md").read()
time = json.load(open(sys.argv[2]))["runs"][0]["time"]


def rows(heading, text=document):
    """The names in the first column of the tables below a heading."""
    part = re.search(rf"^##? {heading}\n(.*?)(?=^## |\Z)", text, re.M | re.S)[1]
    return part, [name for line in part.splitlines() if line.startswith("| `")
                  for name in re.findall(r"`(\w+)`", line.split("|")[1])]


def same(told, counted, what):
    assert set(told) == set(counted), (what, set(told) ^ set(counted))


groups = {"cores", "rasterizers", "pixel_units", "command_processors", "dma_engines", "l2", "llc", "link", "dram", "activities"}
same(rows("The report")[1], set(time) - groups, "the report")
same(rows("Cache", reasons)[1], time["llc"], "caches")
same(rows("Link to the L2", reasons)[1], time["link"], "link")
same(rows("DRAM", reasons)[1], time["dram"], "DRAM")
part, names = rows("Reasons of the clock", reasons)
units = {"cores", "rasterizers", "pixel_units", "command_processors", "dma_engines"}
for unit in units:
    assert unit in names
    for name in (name for one in time[unit] for name in one):
        assert f"`{name}`" in part, (unit, name)
# A machine without DMA engines has none of their reasons.
if time["dma_engines"]:
    assert set(names) - units <= {name for unit in units for name in time[unit][0]}, names
activities = rows("Activities", reasons)[0]
for activity in time["activities"]:
    assert f"`{activity['unit']}`" in activities, activity
    if "instructions" not in activity["unit"]:
        assert f"`{activity['event']}`" in activities, activity
