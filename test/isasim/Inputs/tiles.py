"""usage: tiles.py TILES OFF.json ON.json: checks the tiles of raster-agents.s, and that both runs counted the same."""
import json
import sys

tiles = [json.loads(line) for line in open(sys.argv[1])]
off, on = (json.load(open(f)) for f in sys.argv[2:])
for key in ("total", "raster"):
    assert off[key] == on[key], key
time = on["runs"][0]["time"]
assert "time" not in off["runs"][0]
assert sorted(t["core"] for t in tiles) == list(range(8))
assert {(t["machine"], t["clock_mhz"], t["clock_version"]) for t in tiles} == {("prototype", time["clock_mhz"], time["clock_version"])}
for t in tiles:
    assert t["run"] == 1, t
    assert (t["unit"], t["width"], t["height"], t["list"], t["gaussians"], t["blends"]) == ("rasterizer", 8, 8, 1, 1, 64), t
    assert t["saturated"] == t["status"] == 0
    assert t["begin"] < t["end"] <= time["cycles"], t
# Those of one rasterizer, one after the other, are all that it was busy with.
for socket, unit in enumerate(time["rasterizers"]):
    own = [t for t in tiles if t["core"] // 4 == socket]
    assert all(a["end"] <= b["begin"] for a, b in zip(own, own[1:])), own
    assert sum(t["end"] - t["begin"] for t in own) == time["cycles"] - unit["idle"], socket
