"""Helpers of the tests of paper.sh: shrink CAMERAS OUT (one small view), check OUT DOCUMENT (ratios follow from the runs),
check-training OUT DOCUMENT (the same of training)."""
import json
import os
import sys


def shrink(cameras, out):
    camera = json.load(open(cameras))[0]
    scale = 160 / camera["width"]
    camera.update(width=160, height=96, cx=80, cy=48, fx=camera["fx"] * scale, fy=camera["fy"] * scale)
    json.dump([camera], open(out, "w"))


def near(value, expected):
    assert abs(value - expected) < 1e-9 * abs(expected), (value, expected)


def load(folder, name):
    return json.load(open(os.path.join(folder, "points", name + ".json")))["report"]


def stage(result, name):
    return next(s["time"]["cycles"] for s in result["time"]["stages"] if s["name"] == name)


MACHINES = {"prototype": "scaled", "prototype-forwarding": "scaled-forwarding"}


def check(folder, document):
    pages = os.path.join(os.path.dirname(document), "paper")
    page, joint = (open(os.path.join(pages, name)).read() for name in ("speedup.md", "joint.md"))
    rows = json.load(open(os.path.join(folder, "speedup.json")))["rows"]
    assert [row["machine"] for row in rows] == list(MACHINES)
    for row in rows:
        raster = load(folder, f"scene-front-{row['machine']}-path-raster")
        official = "path-simt-support-official16-tile-16-simt-group-256"
        fastest = f"path-simt-tile-{row['tile']}-simt-group-{row['group']}"
        blend, cycles, ms = stage(raster, "blend"), raster["time"]["sum"]["cycles"], raster["time"]["frame_ms"]
        longest = ms - raster["time"]["kernel_ms"] * min(blend, cycles - blend) / cycles
        for baseline, options in (("fastest", fastest), ("official", official)):
            kernels = load(folder, f"scene-front-{row['machine']}-{options}")
            near(row[baseline]["blending"], stage(kernels, "blend") / blend)
            near(row[baseline]["serial"], kernels["time"]["frame_ms"] / ms)
            near(row[baseline]["overlapped"], kernels["time"]["frame_ms"] / longest)
            near(row[baseline]["bound"], 1 / (1 - stage(kernels, "blend") / kernels["time"]["sum"]["cycles"]))
            assert f"| {row[baseline]['serial']:.2f}x | {row[baseline]['overlapped']:.2f}x |" in page
            assert kernels["time"]["sum"]["machine"] == row["machine"]
        # It draws what the reach calls for, by more work.
        assert row["official"]["frame_cycles"] > row["fastest"]["frame_cycles"]
        assert f"| `{row['machine']}` | official | serial |" in joint
    swept = json.load(open(os.path.join(folder, "choices.json")))["sweeps"][0]["rows"]
    assert len(swept) == 12 and len({row["output_fnv1a64"] for row in swept}) == 1
    fastest = min(row["frame_cycles"] for row in swept if "frame_cycles" in row)
    near(rows[0]["fastest"]["frame_cycles"], fastest)
    rates = json.load(open(os.path.join(folder, "rates.json")))
    for row in rates["rows"]:
        assert row["scaled"] == MACHINES[row["machine"]]
        large = load(folder, f"scene-front-{row['scaled']}-path-raster")
        near(row["serial"]["scaled_fps"], 1e3 / large["time"]["frame_ms"])
        near(row["serial"]["gain"], row["serial"]["scaled_fps"] / row["serial"]["fps"])
        assert row["overlapped"]["fps"] >= row["serial"]["fps"]
    assert len(rates["turns"]) == 2 and all(turn["measured_ms"] > 0 for turn in rates["turns"])
    for row in json.load(open(os.path.join(folder, "clocks.json")))["rows"]:
        for clock, ms in zip(row["clocks_mhz"], row["frame_ms"]):
            assert abs(row["mcycles"] * 1e3 / clock + row["ms"] - ms) <= row["largest_ms_off"] * (1 + 1e-9)


def check_training(folder, document):
    page = open(os.path.join(os.path.dirname(document), "paper", "training.md")).read()
    row, = json.load(open(os.path.join(folder, "training.json")))["rows"]
    state = f"colmap-binary-train-{row['view'].split()[-1]}-by1"
    assert list(row["machines"]) == list(MACHINES)
    for machine, of in row["machines"].items():
        ours = load(folder, f"{state}-{machine}-path-raster")["timed"]
        assert len(ours) == 3
        whole = of["kernels_whole"]
        theirs = load(folder, f"{state}-{machine}-path-simt-tile-{whole['tile']}-simt-group-{whole['group']}")["timed"]

        def ms(samples):
            return sum(s["time"]["frame_ms"] for s in samples) / 3

        def cycles(samples, *names):
            return sum(stage(s, name) for s in samples for name in names) / 3

        near(of["speedup"], ms(theirs) / ms(ours))
        near(of["its"], 1e3 / ms(ours))
        near(of["slow_its"], 1e3 / ms(load(folder, f"{state}-{machine}-path-raster-100MHz")["timed"]))
        near(of["scaled"]["its"], 1e3 / ms(load(folder, f"{state}-{MACHINES[machine]}-path-raster")["timed"]))
        blending = cycles(theirs, "blend", "blend backward", "reduce")
        share = blending / (sum(s["time"]["sum"]["cycles"] for s in theirs) / 3)
        near(of["bound"], 1 / (1 - share))
        near(of["ours"]["backward"], cycles(ours, "blend backward", "reduce"))
        fewest = min(tried["backward"] for tried in of["tried"])
        near(of["back_speedup"], fewest / of["ours"]["backward"])
        assert f"| {of['back_speedup']:.1f}x | {of['speedup']:.2f}x |" in page
        near(of["pairs"], sum(sum(s["list_lengths"]) for s in ours) / 3)
        # Every list entry that is seen changes a pixel, and none changes more than a tile's.
        assert 0 < of["blends_back"] <= of["pairs"] * 32 * 64
    timed = load(folder, f"{state}-prototype-path-raster")
    assert row["density"] == {"interval": timed["run"]["densify"][0], "changed": False}, row["density"]
    assert f"changes after every {timed['run']['densify'][0]} iterations, not in these." in page
    # All of it is of an iteration on the largest machine.
    large = row["largest"]
    largest = load(folder, f"{state}-1024-rasterizers_timing.dram.channels_64-path-raster")["timed"]
    assert len(largest) == 1 and len(largest[0]["time"]["sum"]["rasterizers"]) == 1024
    near(large["rasterizers_ms"] + large["kernels_ms"] + large["host_ms"], largest[0]["time"]["frame_ms"])
    blending = sum(stage(largest[0], name) for name in ("blend", "blend backward"))
    near(large["rasterizers_ms"], blending / largest[0]["time"]["sum"]["clock_mhz"] / 1e3)


{"shrink": shrink, "check": check, "check-training": check_training}[sys.argv[1]](*sys.argv[2:])
