"""Checks the files of --heat-map against the counters of the same picture.

usage: heat_map.py PREFIX OFF.json ON.json COLUMNS ROWS
"""
import json
import os
import struct
import sys

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "..", "intrinsics", "generate"))
import clock

prefix, off, on, columns, rows = sys.argv[1:]
report = json.load(open(prefix + ".json"))
off, on = (json.load(open(f)) for f in (off, on))
assert off["total"]["counters"] == on["total"]["counters"]
assert report["view"] == on["view"] and report["device"] == on["device"]
tiles = report["heat_map"]["tiles"]
assert len(tiles) == int(columns) * int(rows), len(tiles)
counters = on["total"]["counters"]
blends = counters["raster_blends"] + counters["raster_tail_blends"]
assert sum(t["blends"] for t in tiles) == blends > 0
assert sum(t["list"] for t in tiles) == on["counts"]["pairs"]
busy = sum(sum(unit[reason] for reason in clock.busy("rasterizers"))
           for stage in on["time"]["stages"] if "time" in stage
           for unit in stage["time"]["rasterizers"])
cycles = sum(t["cycles"] for t in tiles)
assert 0 < cycles <= busy <= 1.01 * cycles, (cycles, busy)
assert max(t["saturation"] for t in tiles) <= 100
for quantity, scale in report["heat_map"]["scales"].items():
    if quantity != "saturation":
        assert max(t[quantity] for t in tiles) == scale, quantity
    data = open(f"{prefix}.{quantity}.png", "rb").read()
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    width, height = struct.unpack(">II", data[16:24])
    assert (width, height) == (report["resolution"][0], report["resolution"][1] + 24), (width, height)
