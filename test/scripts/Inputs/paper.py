"""Checks the arithmetic of bench/paper; the argument is bench/."""
import os
import sys
import types

sys.path[:0] = [os.path.join(sys.argv[1], "paper"), sys.argv[1]]

import choices
import claims
import clocks
import machines
import runs
import scaling
import scenes
import tiles


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


def check_deal():
    # 9 8 | 6 7 (back) | 5 4: the second row goes the other way.
    near(scaling.deal([9, 8, 7, 6, 5, 4], 2), 20)
    near(scaling.deal([9, 8, 7, 6, 5, 4], 1), 39)
    near(scaling.deal([9, 8, 7], 5), 9)
    assert scaling.jobs_of([3, 10], 4) == [2, 3, 2, 3, 0, 1, 1, 1]


def check_model():
    unit = {"blend": 700, "clip": 0, "fetch": 0, "hazard": 0, "begin": 20, "flush": 0, "drain": 80, "idle": 5, "commands": 2}
    rows = {row["rasterizers"]: row for row in scaling.model([5, 2], 1, [unit], 300)}
    near(rows[1]["compute"], 800)
    near(rows[2]["compute"], 550)
    near(rows[1024]["compute"], 550)
    rows = {row["rasterizers"]: row for row in scaling.model([5, 2], 1, [unit], 6400)}
    near(rows[16]["cycles_with_memory"], 6400)
    near(rows[64]["cycles"], 6400)
    near(rows[64]["cycles_with_memory"], 1600)


def check_verdicts():
    rows = [{"scene": "a", "view": "x", "v": 2}, {"scene": "b", "view": "y", "v": 5}]
    value = lambda row: row["v"]
    assert claims.verdict(rows, value, claims.at_least(2)) == claims.HOLDS
    assert claims.verdict(rows, value, claims.at_least(6)) == claims.NOT
    assert claims.verdict(rows, value, claims.at_least(3)) == "holds if the view is b y (1 of 2 views)"
    assert claims.about(10)(20) and claims.about(10)(5) and not claims.about(10)(21) and not claims.about(10)(4)
    assert claims.ratios(rows, value, 2) == "1.00 to 2.50"


def check_occlusion():
    assert tiles.reached([0, 0.5, 0.9, 1]) == 2
    assert tiles.reached([0, 0.5]) is None


class Store:
    """Answers with made-up results and counts what was clocked."""
    jobs = 1

    def __init__(self, instructions, cycles):
        self.instructions, self.cycles, self.clocked = instructions, cycles, []

    def all(self, wanted, _title):
        return [self.result(run) for run in wanted]

    def result(self, run):
        choice = (int(run.options[3]), int(run.options[5]))
        blend = self.instructions[choice]
        result = {"counts": {"pairs": 1}, "picture_sha256": "", "device": {"compute_units": 8},
                  "stages": [{"name": "blend", "kernels": [{"counters": {"warp_instructions": blend}}]}],
                  "total": {"counters": {"warp_instructions": blend + 8}}}
        if run.clock is not None:
            self.clocked.append(choice)
            cycles = self.cycles.get(choice, 10 * blend)
            result["time"] = {"sum": {"cycles": cycles + 2}, "stages": [{"name": "blend", "time": {"cycles": cycles}}]}
        return result


def check_sweep():
    """A choice is left out if, and only if, it could not win even at an instruction a cycle."""
    instructions = {c: 1000 * (k + 1) for k, c in enumerate(choices.CHOICES)}
    fast = choices.CHOICES[2]
    store = Store(instructions, {fast: 700})
    scene = scenes.Scene("s", "s.ply", "c.json", ("v",))
    swept = choices.sweep(store, scene, "v")
    # 700 cycles on 8 cores have room for 5,600 instructions: five choices, not the sixth.
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
    assert "--time" in wanted[2].arguments("p", "r") and "--time" not in wanted[0].arguments("p", "r")


def check_machines():
    assert machines.config("16-rasterizers") == machines.config("scaled")
    assert machines.config("scaled-16-channels")["timing"]["dram"]["channels"] == 16
    for count in scaling.SIMULATED:
        config = machines.config(f"{count}-rasterizers")
        assert config["clusters"] * config["sockets_per_cluster"] == count
        assert count * config["cores_per_socket"] <= machines.MOST_CORES


for check in [value for name, value in list(globals().items()) if isinstance(value, types.FunctionType) and name.startswith("check_")]:
    check()
print("all checked")
