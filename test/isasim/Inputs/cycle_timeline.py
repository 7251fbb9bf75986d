"""usage: cycle_timeline.py TIMELINE STATS: checks a timeline in cycles against the time of the same runs, and prints its
groups of rows. What the slices say of a unit adds up to its cycles, reason by reason."""
import collections
import json
import sys

timeline, stats = (json.load(open(f)) for f in sys.argv[1:])
assert timeline["otherData"]["format"] == "vorion-timeline 1"
time = stats["runs"][0]["time"]
assert timeline["otherData"]["unit"] == f"1 us = 1 cycle of {time['machine']}, {time['clock_mhz']} MHz, clock version {time['clock_version']}", timeline["otherData"]
groups, names, ends, figures = {}, {}, {}, collections.defaultdict(list)
spent = collections.defaultdict(collections.Counter)
for event in timeline["traceEvents"]:
    pid = event["pid"]
    if event["ph"] == "M":
        if event["name"] == "process_name":
            groups[pid] = event["args"]["name"]
        else:
            names[pid, event["tid"]] = event["args"]["name"]
    elif event["ph"] == "C":
        if groups[pid] == "power":  # in mW; the rest is in per cent
            assert event["args"]["value"] > 0, event
            continue
        assert 0 <= event["args"]["value"] <= 100, event
        figures[groups[pid], event["name"]].append((event["ts"], event["args"]["value"]))
    else:
        row = groups[pid], names[pid, event["tid"]]
        assert ends.get(row, 0) <= event["ts"], f"slices overlap: {event}"
        ends[row] = event["ts"] + event["dur"]
        if groups[pid] != "runs":
            assert sum(event["args"].values()) == event["dur"], event
            assert event["args"][event["name"]] > 0, event
            spent[row].update(event["args"])
timed = [run["time"] for run in stats["runs"]]
assert ends["runs", "runs"] == sum(time["cycles"] for time in timed)
HOST = "command processor and DMA"
for group, one, key in (("cores", "core", "cores"), ("rasterizers", "rasterizer", "rasterizers"),
                        ("pixel units", "pixel unit", "pixel_units"),
                        (HOST, "command processor", "command_processors"), (HOST, "DMA engine", "dma_engines")):
    units = len(timed[0][key])
    for unit in range(units):
        row = group, f"{one} {unit}"
        for reason, cycles in spent[row].items():
            assert cycles == sum(time[key][unit][reason] for time in timed), (group, unit, reason)
        assert spent[row].total() == ends["runs", "runs"], row
    print(f"{one if group == HOST else group}: {units} rows")
for group in ("link", "L2", "last-level cache", "DRAM"):
    print(f"{group}: {sum(g == group for g, name in figures)} figures")
# The figures are tenths of a per cent, rounded; what a run began may end behind it.
end = ends["runs", "runs"]


def check_busy(exact, rows):
    busy = sum(value / 100 * (behind - begin) for row in rows
               for (begin, value), (behind, _) in zip(figures[row], figures[row][1:] + [(end, 0)]))
    rounded = 0.00051 * len(rows) * end
    assert exact - rounded - 16 <= busy <= exact + rounded + 4 * len(rows), (rows, busy, exact)


check_busy(sum(time["dram"]["bus_ps"] * time["clock_mhz"] / 1e6 for time in timed), [row for row in figures if row[0] == "DRAM"])
for way in ("to", "from"):
    row = "link", f"{way} the L2, % busy"
    check_busy(sum(time["link"][f"busy_{way}_l2"] for time in timed), [row] if row in figures else [])
