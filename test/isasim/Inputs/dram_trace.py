"""usage: dram_trace.py PREFIX STATS CHANNELS: checks the files of --dram-trace against the counters of the same run."""
import collections
import json
import re
import sys

prefix, stats, channels = sys.argv[1], json.load(open(sys.argv[2])), int(sys.argv[3])
dram = stats["runs"][0]["time"]["dram"]
counted = collections.Counter()
for channel in range(channels):
    ticks, opened = 0, set()
    for line in open(f"{prefix}.{channel}.commands"):
        tick, command, bank = re.fullmatch(r"(\d+),([A-Z]+),(\d+)\n", line).groups()
        assert int(tick) >= ticks, line
        ticks = int(tick)
        counted[command] += 1
        # A row is open where something is read.
        if command == "ACT":
            assert bank not in opened, line
            opened.add(bank)
        elif command == "PRE":
            opened.remove(bank)
        elif command == "PREA":
            opened.clear()
        elif command in ("RD", "WR"):
            assert bank in opened, line
assert counted["RD"] == dram["read_bursts"] > 0, counted
assert counted["WR"] == dram["write_bursts"], counted
assert counted["ACT"] == dram["activations"] > 0, counted
assert counted["REF"] + counted["REFB"] == dram["refreshes"], counted
requests = [re.fullmatch(r"0x([0-9a-f]{8}) ([RW])\n", line).groups() for line in open(prefix + ".requests")]
assert all(int(address, 16) < 1 << 32 for address, kind in requests)
lines = sum(kind == "R" for address, kind in requests)
bursts = 64 // stats["runs"][0]["time"]["host"]["dram_burst_bytes"]
assert (lines - dram["forwarded"]) * bursts == dram["read_bursts"], (lines, dram)
