"""Checks the arithmetic of bench/paper; the argument is bench/."""
import json
import os
import sys
import tempfile
import types

sys.path[:0] = [os.path.join(sys.argv[1], "paper"), sys.argv[1]]

import choices
import claims
import clocks
import document
import draws
import earlier
import energy
import hypercube
import joint
import machines
import priors
import runs
import scaling
import scenes
import tiles
import timed_frame
import verdicts


def near(value, expected):
    assert abs(value - expected) < 1e-9 * max(1, abs(expected)), (value, expected)


def check_fit():
    a, b, off = clocks.fit((100, 200, 400), [1e3 * 3 / f + 7 for f in (100, 200, 400)])
    near(a, 3)
    near(b, 7)
    near(off, 0)
    # A middle point that is 3 ms late bends the line, and is what is off.
    a, b, off = clocks.fit((100, 200, 400), [1e3 * 3 / f + (10 if f == 200 else 7) for f in (100, 200, 400)])
    assert 1 < off < 3 and b > 7


def check_verdicts():
    """Verdicts go by the share; its interval is Wilson's, by the published example of 8 of 10."""
    assert verdicts.verdict(57, 60) == verdicts.HOLDS and verdicts.verdict(56, 60) == verdicts.OPEN
    assert verdicts.verdict(3, 60) == verdicts.NOT and verdicts.verdict(4, 60) == verdicts.OPEN
    low, high = verdicts.wilson(8, 10)
    assert abs(low - 0.4902) < 1e-4 and abs(high - 0.9433) < 1e-4, (low, high)
    # All of 60: z^2 / (n + z^2) are left; and a share and the rest of it mirror each other.
    low, high = verdicts.wilson(60, 60)
    near(low, 60 / (60 + 1.959963984540054 ** 2))
    near(high, 1)
    near(verdicts.wilson(0, 60)[1], 1 - low)
    assert verdicts.share_text(57, 60, "draws") == "57 of 60 draws, 86-98 %"
    near(verdicts.interval(list(range(101)))[0], 5)
    assert verdicts.interval([3, 1]) == (1, 2, 3)
    assert verdicts.about(10)(20) and verdicts.about(10)(5) and not verdicts.about(10)(21) and not verdicts.about(10)(4)
    trials = [verdicts.Trial(2, "a x", machine="p"), verdicts.Trial(5, "b y", machine="p")]
    assert verdicts.ratios(trials, 2) == "1.00 to 2.50"
    assert verdicts.span(trials, "x") == "`p` 2x (a x) to 5x (b y), median 3.5x"


def check_claims():
    """A rate of a workload that is smaller than the paper's decides nothing; and all claims have a group."""
    fps = claims.BY_KEY["fps"]
    small, large = (verdicts.Trial(20, "v", gaussians=n) for n in (1000, 1_000_000))
    row = document._row(fps, [small, small], "rates", "views")
    assert row["verdict"] == verdicts.OPEN and "smaller" in row["held"], row
    row = document._row(fps, [small, large], "rates", "views")
    assert row["verdict"] == verdicts.HOLDS and row["held"].startswith("1 of 1 views"), row
    # Less work that does not reach it decides; but for "about".
    slow = verdicts.Trial(10, "v", gaussians=1000)
    assert document._row(fps, [slow], "rates", "views")["verdict"] == verdicts.NOT
    assert document._row(claims.BY_KEY["fixed_ms"], [slow], "clocks", "views")["verdict"] == verdicts.OPEN
    assert {claim.group for claim in claims.CLAIMS} <= set(claims.GROUPS)
    assert set(claims.BY_KEY) <= set(earlier.VERDICTS)
    assert set(draws.FIGURES) - set(claims.BY_KEY) == {"not_blending"}


def check_hypercube():
    """Each of as many parts of a factor is used once, whatever follows what; and factors follow each other as wanted."""
    keys = [factor.key for factor in priors.FACTORS] + [("other", str(n)) for n in range(30)]
    drawn = hypercube.parts(keys, 60, 1, priors.CORRELATIONS)
    for key in keys:
        assert sorted(int(60 * sample[key]) for sample in drawn) == list(range(60)), key
    wanted = {frozenset((a, b)): value for a, b, value in priors.CORRELATIONS}
    for a in keys:
        for b in keys[:keys.index(a)]:
            found = hypercube.rank_correlation([sample[a] for sample in drawn], [sample[b] for sample in drawn])
            # Without a wish it is chance: 5 standard errors.
            assert abs(found - wanted.get(frozenset((a, b)), 0)) < (0.06 if frozenset((a, b)) in wanted else 0.65), (a, b, found)
    few = hypercube.parts(keys, 3, 1, priors.CORRELATIONS)
    assert all(sorted(int(3 * sample[key]) for sample in few) == [0, 1, 2] for key in keys)
    assert drawn == hypercube.parts(keys, 60, 1, priors.CORRELATIONS) != hypercube.parts(keys, 60, 2, priors.CORRELATIONS)
    try:
        hypercube.parts("abc", 60, 1, [("a", "b", 0.9), ("b", "c", 0.9), ("a", "c", -0.9)])
    except ValueError as error:
        assert "positive definite" in str(error)
    else:
        raise AssertionError("impossible correlations are refused")
    assert hypercube.value_at(["x", "y"], 0.49) == "x" and hypercube.value_at(["x", "y"], 0.5) == "y"
    assert [hypercube.value_at((10, 1000), part) for part in (0, 0.5, 1)] == [10, 100, 1000]
    assert hypercube.ranks([5, 1, 5]) == [1.5, 0, 1.5]


def check_priors():
    """What is drawn of a machine is within its limits, and what it is now is within what is drawn."""
    timing = timed_frame.machine("prototype")["timing"]
    domains = priors.of_clock(timing)
    for (group, name), domain in domains.items():
        now = timing[group][name]
        assert now in domain if isinstance(domain, list) else domain[0] <= now <= domain[1], (group, name, now, domain)
    assert not any(group == "link" for group, _ in priors.of_clock(timed_frame.machine("scaled")["timing"]))


def summary(ms, **counts):
    stages = {name: {"host_ms": 0.5, "ms": time, "shares": {"memory": 0.5}} for name, time in ms.items()}
    return {"gaussians": 100, "visible": 50, "pairs": 200, "blends": 1000, "work": 10, "lane_slots": 5000, "busy": 100, "on_lists": 80,
            "stages": stages, **counts}


def check_draws():
    """Figures of a draw from stages whose times are known."""
    scene = scenes.Scene("s", "s.ply", "c.json", ("v",))
    draw = draws.Draw("00", draws.Place(scene, scene, "v"), 0)
    frame, kernels = summary({"project": 4, "blend": 6}), summary({"project": 1, "blend": 30}, blends=0)
    found = {"frame": frame, "slow": summary({"project": 21.2, "blend": 31.8}), "scaled": summary({"project": 1, "blend": 1}), "kernels": kernels,
             "handed": summary({"project": 4, "blend": 5}, on_lists=70)}
    counts = {"whole": frame, "crop": summary({}, blends=100), "lists": summary({}, pairs=400)}
    made = draws.figures(draws.Sampled(draw, found, counts, {}))
    near(made["fps"], 1e3 / 11)
    near(made["gain"], 11 / 3)
    near(made["not_blending"], 100 * 5 / 11)
    near(made["mcycles"], 43 / (10 - 1e3 / 530))
    near(made["blending"], 50)  # a tenth of the blends in the crop
    near(made["times"], (300 + 4 + 1) / 11)
    near(made["quarter"], 10)
    near(made["quarter_gain"], 20)
    near(made["lanes"], 20)
    assert made["joint"] == 2 and "linear" not in made, made
    # Twice as long where memory has half of the time, and overlapped in the time of the longest stage.
    drawn = draws.Draw("00", draw.place, 0, fixed={("part", "memory"): 300, ("method", "pipeline"): "overlapped"})
    near(draws.figures(draws.Sampled(drawn, found, counts, {}))["fps"], 1e3 / 13)
    # Ten times the Gaussians and four times the work.
    target = draws.Sampled(draw, found, {**counts, "target": summary({}, gaussians=1000, work=40)},
                           {"prototype: blending": 2, "prototype: the rest": 0.5})
    near(draws.figures(target)["fps"], 1e3 / (1 + 20 + 48))
    near(draws.figures(target)["times"], (1 + 20 + 4 * 300) / (1 + 20 + 48))
    # Off by a factor of 4 in the mean, and of 2 beside it; a crop's error is its blending's.
    near(draws.correction([{"ours": 2, "whole": 1}, {"ours": 8, "whole": 1}])[0], 0.25)
    near(draws.correction([{"ours": 2, "whole": 1}, {"ours": 8, "whole": 1}])[1], 2)
    assert draws.correction([]) == (1, 1)
    near(draws.figures(draws.Sampled(draw, found, counts, {draws.KERNELS: 0.5}))["blending"], 25)
    assert draws._merged({"a": {"b": 1, "c": 2}}, {"a": {"b": 3}}) == {"a": {"b": 3, "c": 2}}


def check_crops():
    """The crops of a view are whole tiles of it, and its rays pass the same pixels."""
    with tempfile.TemporaryDirectory() as folder:
        cameras = os.path.join(folder, "c.json")
        with open(cameras, "w") as f:
            json.dump([{"img_name": "v", "width": 960, "height": 544, "fx": 800.0, "fy": 810.0}], f)
        for number in range(len(draws.CROPS)):
            crop = draws.cropped(scenes.Scene("s", "s.ply", cameras, ("v",)), "v", number, folder)
            camera, = json.load(open(os.path.join(scenes.ROOT, crop.cameras)))
            assert camera["width"] == 192 and camera["height"] == 192 and camera["fx"] == 800
            begin = 480 - camera["cx"], 272 - camera["cy"]
            assert all(at % draws.TILE == 0 for at in begin) and 0 <= begin[0] <= 768 and 0 <= begin[1] <= 352, begin


def check_joint():
    """Each figure is met by itself, and the official algorithm is left out where it was not measured."""
    at = {"scene": "s", "view": "v", "machine": "prototype"}
    speed = {"fps": 19, "slow_fps": 6.3, "gain": 8}
    rate = {**at, "frame_cycles": 1e6, "serial": speed, "overlapped": {**speed, "slow_fps": 6.4}}
    kernels = {"serial": 30.1, "overlapped": 30.2, "frame_cycles": 2e6, "blend_share": 0.9}
    rows = joint.rows_of({"rows": [rate]}, {"rows": [{**at, "fastest": kernels, "official": None}]})
    assert [row["met"] for row in rows] == [["fps", "gain"], ["fps", "slow_fps", "times", "gain"]], rows
    assert not joint.rows_of({"rows": [{**rate, "view": "w"}]}, {"rows": [{**at, "fastest": kernels, "official": None}]})
    near(joint.FRAME_MCYCLES * 30.2, joint.KERNELS_MCYCLES[0])
    near(joint.off({"fps": 19, "slow_fps": 12.8, "times": 35, "gain": 8}), 2)
    near(joint.off({"fps": 19, "slow_fps": 6.4, "times": 76.8, "gain": 4}), 2)
    near(joint.off({"fps": 19, "slow_fps": 6.4, "times": 10, "gain": 8}), 3.02)


def check_overlap():
    """The longer stage, and what the host takes."""
    stages = [{"name": "project", "time": {"cycles": 300}}, {"name": "blend", "time": {"cycles": 100}}]
    result = {"time": {"frame_ms": 5, "kernel_ms": 4, "sum": {"cycles": 400}, "stages": stages}}
    near(runs.overlapped_ms(result), 4)
    stages[1]["time"]["cycles"], result["time"]["sum"]["cycles"] = 900, 1200
    near(runs.overlapped_ms(result), 4)


def check_occlusion():
    assert tiles.reached([0, 0.5, 0.9, 1]) == 2
    assert tiles.reached([0, 0.5]) is None


class Store:
    """Answers with made-up results and counts what was clocked."""
    jobs = 1

    def __init__(self, instructions, cycles):
        self.instructions, self.cycles, self.clocked = instructions, cycles, []

    def all(self, wanted):
        return [self.result(run) for run in wanted]

    def result(self, run):
        choice = (int(run.options[3]), int(run.options[5]))
        blend = self.instructions[choice]
        result = {"counts": {"pairs": 1}, "output_fnv1a64": "", "device": {"compute_units": 8},
                  "stages": [{"name": "blend", "kernels": [{"counters": {"warp_instructions": blend}}]}],
                  "total": {"counters": {"warp_instructions": blend + 8}}}
        if run.clock is not None:
            self.clocked.append(choice)
            cycles = self.cycles.get(choice, 100 * blend)
            result["time"] = {"sum": {"cycles": cycles + 2}, "stages": [{"name": "blend", "time": {"cycles": cycles}}]}
        return result


def check_sweep():
    """A choice is left out if, and only if, it could not win even at as many instructions as a core can fetch."""
    instructions = {c: 1000 * (k + 1) for k, c in enumerate(choices.CHOICES)}
    fast = choices.CHOICES[2]
    interval = machines.fetch_interval(choices.MACHINE)
    assert interval > machines.fetch_interval("prototype-forwarding") == 1
    store = Store(instructions, {fast: 700 * interval})
    scene = scenes.Scene("s", "s.ply", "c.json", ("v",))
    swept = choices.sweep(store, scene, "v")
    # 700 fetches on 8 cores have room for 5,600 instructions: five choices, not the sixth.
    assert store.clocked == list(choices.CHOICES[:5]), store.clocked
    assert choices.candidates(swept) == [fast]


def check_names():
    """No two runs share a file."""
    scene = scenes.Scene("s", "s.ply", "c.json", ("v",))
    wanted = [runs.Run(scene, "v", "prototype", options, clock, threads)
              for options in ((), ("--ztiles", "4"), ("--ztiles", "4", "--cutoff", "0"), ("--pixel-unit", "last:1/4"),
                              ("--pixel-unit", "last:1/2"))
              for clock in (None, 0, 100) for threads in (0, 1)]
    assert len({run.name() for run in wanted}) == len(wanted)
    assert "--time" in wanted[2].point().command and "--time" not in wanted[0].point().command


def check_machines():
    assert machines.config("prototype") == {"machine": "prototype"}
    assert machines.channels("16-rasterizers") == machines.channels("scaled") == 8
    assert machines.channels("prototype") == machines.channels("prototype-forwarding") == 1
    assert machines.channels("scaled-16-channels") == 16
    assert machines.shown("scaled") == "scaled"
    scaled = machines.parameters("scaled")
    for count in scaling.SIMULATED:
        config = machines.config(f"{count}-rasterizers")
        assert config["clusters"] * config["sockets_per_cluster"] == count
        assert config["cores_per_socket"] == scaled["cores_per_socket"]
        assert ("stack_bytes" in config) == (count >= 512)
        if count == scaling.RASTERIZERS_A_MEMORY:
            assert all(scaled[key] == value for key, value in config.items() if key != "machine")
    assert machines.channels(scaling.grown(scaling.RASTERIZERS_A_MEMORY)) == machines.channels("scaled")
    assert machines.channels(scaling.grown(1024)) == scaling.MOST_CHANNELS
    for name in machines.NAMED:
        assert machines.parameters(name)["timing"]["dram"]["channels"]


def check_widths():
    """A scene in another size: the same rays in as many more pixels."""
    with tempfile.TemporaryDirectory() as folder:
        cameras = os.path.join(folder, "c.json")
        with open(cameras, "w") as f:
            json.dump([{"img_name": "v", "width": 960, "height": 544, "fx": 800.0, "fy": 810.0}], f)
        large = scenes.at_width(scenes.Scene("s", "s.ply", cameras, ("v",)), 1920, folder)
        camera, = json.load(open(os.path.join(scenes.ROOT, large.cameras)))
        assert large.name == "s-1920x1088" and large.views == ("v",)
        assert camera == {"img_name": "v", "width": 1920, "height": 1088, "fx": 1600.0, "fy": 1620.0}, camera


def check_energy():
    """A claim is answered given what it is not about."""
    def estimate(value):
        return {"value": value, "low": value, "high": value}

    def figures(mean, peak, um2):
        parts = [{"part": part, "um2": estimate(um2 / 4)} for part in energy.RASTERIZER]
        return {"chip_watts": estimate(mean), "peak_watts": estimate(peak), "area": {"chip_um2": estimate(um2), "parts": parts},
                "samples": {"kept": 1000, "tried": 5000}, "rows": []}

    given = {"area": figures(0.5, 0.5, 1.6e6), "power": figures(0.7, 0.7, 3e6), "area_and_power": figures(0.4, 0.9, 1.6e6)}
    rows = [{"scene": "s", "view": "v", "machine": "prototype", "clock": clock, "command": "", "given": given, **figures(0.8, 0.8, 4e6)}
            for clock in energy.CLOCKS]
    claims = energy.claims_of({"rows": rows})
    assert [claim["verdict"] for claim in claims[:4]] == [verdicts.HOLDS, verdicts.NOT, verdicts.HOLDS, verdicts.NOT], claims
    assert "given the area; without: does not hold" in claims[0]["ours"] and "given the power" in claims[3]["ours"]
    # 9.5 frames/s of 0.8 mm2 at 530 MHz, over 67 of 2.43 mm2 at 1 GHz.
    assert abs(energy.efficiency(given["area"]) - 9.5 / 0.8 / 530 / (67 / 2.43 / 1000)) < 1e-9
    assert energy.moved([{"row": str(value), "factor": estimate(value)} for value in (1, 0.5, 3)], 2)[0]["row"] == "3"


for check in [value for name, value in list(globals().items()) if isinstance(value, types.FunctionType) and name.startswith("check_")]:
    check()
print("all checked")
