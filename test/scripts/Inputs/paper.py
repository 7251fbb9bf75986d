"""Checks the arithmetic of bench/paper; the argument is bench/."""
import json
import os
import sys
import tempfile
import types

sys.path[:0] = [os.path.join(sys.argv[1], "paper"), sys.argv[1]]

import choices
import clocks
import joint
import machines
import runs
import scaling
import scenes
import tiles
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
    rows = [{"scene": "a", "view": "x", "machine": "p", "v": 2}, {"scene": "b", "view": "y", "machine": "p", "v": 5}]
    value = lambda row: row["v"]

    def said(number, rows, rate=False):
        return verdicts.verdict(rows, value, verdicts.at_least(number), rate)

    assert said(2, rows) == verdicts.HOLDS
    assert said(6, rows) == verdicts.NOT
    assert said(3, rows) == "holds if the view is b y on `p` (1 of 2)"
    assert said(3, rows, rate=True) == verdicts.NOT_COMPARABLE
    # Every view may reach a rate, and another workload not.
    assert said(1, rows) == verdicts.HOLDS and said(1, rows, rate=True) == verdicts.NOT_COMPARABLE
    # The other core: slower, so that no view reaches 3.
    slower = [{**row, "machine": "q", "v": row["v"] / 2} for row in rows]
    assert said(3, rows + slower) == verdicts.DEPENDS and said(3, slower + rows, rate=True) == verdicts.DEPENDS
    assert said(6, rows + slower) == verdicts.NOT
    assert said(1, rows + slower) == verdicts.HOLDS
    assert said(2, rows + slower) == "holds if the view is any on `p` (2 of 2); b y on `q` (1 of 2)"
    assert verdicts.about(10)(20) and verdicts.about(10)(5) and not verdicts.about(10)(21) and not verdicts.about(10)(4)
    assert verdicts.ratios(rows, value, 2) == "1.00 to 2.50"


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


for check in [value for name, value in list(globals().items()) if isinstance(value, types.FunctionType) and name.startswith("check_")]:
    check()
print("all checked")
