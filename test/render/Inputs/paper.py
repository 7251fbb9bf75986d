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
    return json.load(open(os.path.join(folder, "runs", name + ".json")))


def stage(result, name):
    return next(s["time"]["cycles"] for s in result["time"]["stages"] if s["name"] == name)


def check(folder, document):
    table = open(document).read()
    rows = json.load(open(os.path.join(folder, "speedup.json")))["rows"]
    assert [row["machine"] for row in rows] == ["prototype", "scaled"]
    for row in rows:
        raster = load(folder, f"scene-front-{row['machine']}-path-raster")
        simt = {part: load(folder, f"scene-front-{row['machine']}-path-simt-simt-tile-{row['kernels_' + part]['tile']}"
                                   f"-simt-group-{row['kernels_' + part]['group']}") for part in ("blend", "frame")}
        near(row["blend_speedup"], stage(simt["blend"], "blend") / stage(raster, "blend"))
        near(row["frame_speedup"], simt["frame"]["time"]["frame_ms"] / raster["time"]["frame_ms"])
        share = stage(simt["frame"], "blend") / simt["frame"]["time"]["sum"]["cycles"]
        near(row["bound"], 1 / (1 - share))
        near(row["fps"], 1e3 / raster["time"]["frame_ms"])
        line = next(x for x in table.splitlines() if x.startswith("| scene | front") and f"{row['bound']:.2f}x" in x)
        assert f"| {row['blend_speedup']:.1f}x | {row['frame_speedup']:.2f}x |" in line, line
    swept = json.load(open(os.path.join(folder, "choices.json")))["sweeps"][0]["rows"]
    assert len(swept) == 12 and len({row["picture_sha256"] for row in swept}) == 1
    fastest = min(row["blend_cycles"] for row in swept if "blend_cycles" in row)
    near(rows[0]["kernels_blend"]["blend_cycles"], fastest)
    # Kernels alone are what every speed-up is over, so they must not get slower: 8.98 when this was written.
    assert rows[0]["kernels_blend"]["instructions_a_blend"] < 9.1, rows[0]["kernels_blend"]
    for row in json.load(open(os.path.join(folder, "clocks.json")))["rows"]:
        for clock, ms in zip(row["clocks_mhz"], row["frame_ms"]):
            assert abs(row["mcycles"] * 1e3 / clock + row["ms"] - ms) <= row["largest_ms_off"] * (1 + 1e-9)


def check_training(folder, document):
    table = open(document).read()
    row, = json.load(open(os.path.join(folder, "training.json")))["rows"]
    state = f"colmap-binary-train-{row['view'].split()[-1]}"
    for machine in ("prototype", "scaled"):
        ours = load(folder, f"{state}-{machine}-path-raster")["timed"]
        assert len(ours) == 3
        whole = row[machine]["kernels_whole"]
        theirs = load(folder, f"{state}-{machine}-path-simt-simt-tile-{whole['tile']}-simt-group-{whole['group']}")["timed"]

        def ms(samples):
            return sum(s["time"]["frame_ms"] for s in samples) / 3

        def cycles(samples, *names):
            return sum(stage(s, name) for s in samples for name in names) / 3

        near(row[machine]["speedup"], ms(theirs) / ms(ours))
        near(row[machine]["its"], 1e3 / ms(ours))
        blending = cycles(theirs, "blend", "blend backward", "reduce")
        share = blending / (sum(s["time"]["sum"]["cycles"] for s in theirs) / 3)
        near(row[machine]["bound"], 1 / (1 - share))
        near(row[machine]["ours"]["backward"], cycles(ours, "blend backward", "reduce"))
        fewest = min(tried["backward"] for tried in row[machine]["tried"])
        near(row[machine]["back_speedup"], fewest / row[machine]["ours"]["backward"])
        assert f"| {row[machine]['back_speedup']:.1f}x | {row[machine]['speedup']:.2f}x |" in table
        near(row[machine]["pairs"], sum(sum(s["list_lengths"]) for s in ours) / 3)
        # Every list entry that is seen changes a pixel, and none changes more than a tile's.
        assert 0 < row[machine]["blends_back"] <= row[machine]["pairs"] * 32 * 64
    timed = load(folder, f"{state}-prototype-path-raster")
    assert row["density"] == {"interval": timed["run"]["densify"][0], "changed": False}, row["density"]
    assert f"changes after every {timed['run']['densify'][0]} iterations, not in these." in table
    large = row["largest"]
    assert 0 < large["rasterizers_ms"] + large["kernels_ms"] < row["scaled"]["ours"]["ms"], large


{"shrink": shrink, "check": check, "check-training": check_training}[sys.argv[1]](*sys.argv[2:])
