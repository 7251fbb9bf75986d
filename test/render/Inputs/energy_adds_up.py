"""usage: energy_adds_up.py FRAME LOWER-VOLTAGE KERNELS-ALONE: units, stages and kernels of each report add up to the frame; the
first takes more than the second, and its chip less than the third's."""
import json
import sys


def near(a, b):
    assert abs(a - b) <= 1e-9 * max(a, b), (a, b)


def energy(file):
    with open(file, encoding="utf-8") as f:
        e = json.load(f)["energy"]
    for given in e.get("given_chip", {}).values():
        adds_up(given)
        assert given["samples"]["kept"] == 1000 < given["samples"]["tried"], given["samples"]
    return adds_up(e)


def width(figure):
    return figure["high"] / figure["low"]


def adds_up(e):
    near(sum(u["joules"]["value"] for u in e["units"]), e["joules"]["value"])
    near(sum(u["joules"]["value"] for u in e["units"] if u["on_chip"]), e["chip_joules"]["value"])
    near(sum(u["share"]["value"] for u in e["units"]), 1)
    for kind in ("joules", "chip_joules"):
        near(sum(s[kind]["value"] for s in e["stages"]), e[kind]["value"])
        for s in e["stages"]:
            near(sum(k[kind]["value"] for k in s["kernels"]), s[kind]["value"])
    near(e["watts"]["value"] * e["seconds"], e["joules"]["value"])
    for figure in [e["joules"], e["chip_joules"], *(u["joules"] for u in e["units"])]:
        assert figure["low"] < figure["value"] < figure["high"], figure
    off_chip = {"l2", "llc"}
    near(sum(p["um2"]["value"] for p in e["area"]["parts"] if p["part"] not in off_chip), e["area"]["chip_um2"]["value"])
    return e


frame, lower, kernels = map(energy, sys.argv[1:])
# The chip's area and power are less than the technology's, and known better.
both = frame["given_chip"]["area_and_power"]
assert both["area"]["chip_um2"]["high"] < frame["area"]["chip_um2"]["low"]
assert width(both["chip_watts"]) < width(frame["chip_watts"])
assert width(frame["given_chip"]["area"]["chip_watts"]) > width(both["chip_watts"])
assert frame["joules"]["value"] > lower["joules"]["value"]
assert frame["chip_joules"]["value"] < kernels["chip_joules"]["value"]
assert {u["unit"] for u in frame["units"]} >= {"rasterizer lanes", "rasterizer buffers"}
