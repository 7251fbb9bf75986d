"""What bench/uncertainty.py makes of a report whose answer is known, and its table of parts beside the document's.
usage: uncertainty.py ROOT"""

import math
import subprocess
import sys

ROOT = sys.argv[1]
sys.path.insert(0, f"{ROOT}/bench")
import priors  # noqa: E402
import uncertainty  # noqa: E402


def unit(parts, **cycles):
    return {**dict.fromkeys((*parts, "ended", "barrier", "idle", "clip"), 0), **cycles}


def stage(cores, rasterizers, busy, **more):
    return {"of_the_frame": True, "launch_ms": 0.5, "copy_ms": 0.25,
            "time": {"cycles": 2000, "clock_mhz": 1, "cores": cores, "rasterizers": rasterizers,
                     "link": {"busy_to_l2": busy[0], "busy_from_l2": busy[1]}}, **more}


def near(time, factors, wanted):
    got = uncertainty.frame_ms({"stages": time}, factors)
    assert math.isclose(got, wanted), (factors, got, wanted)


def main():
    core = unit(uncertainty.CORES, issue=40, memory=20, link=20, raster_full=20, ended=7)
    rasterizer = unit(uncertainty.RASTERIZERS, blend=30, fetch=10, idle=100)
    one = [stage([core], [rasterizer], (30, 10))]
    near(one, {}, 2.75)
    near(one, {"instructions": 150}, 0.75 + 2 * 1.2)
    # A fifth of the time waits for the rasterizer, which spends a quarter of its own on memory.
    near(one, {"memory": 200}, 0.75 + 2 * (1 + 0.2 + 0.05))
    near(one, {"rasterizer": 0}, 0.75 + 2 * (1 - 0.15))
    near(one, {"stores on the link": 0}, 0.75 + 2 * (1 - 0.2 * 0.75))
    # Stages outside of the frame, those without launches, and links without a rate.
    near([*one, {**one[0], "of_the_frame": False}], {}, 2.75)
    near([{"of_the_frame": True, "launch_ms": 0, "copy_ms": 1}], {"memory": 200}, 1)
    near([stage([core], [], (0, 0))], {"stores on the link": 0, "rasterizer": 200}, 0.75 + 2 * 1.2)
    for factor in priors.in_group("part"):
        assert 0 < factor.domain[0] <= 100 <= factor.domain[1], factor

    table = subprocess.run([sys.executable, f"{ROOT}/bench/uncertainty.py", "--parts"], check=True, capture_output=True, text=True)
    with open(f"{ROOT}/docs/tables/validation.md", encoding="utf-8") as f:
        assert table.stdout in f.read(), "docs/tables/validation.md: not the table of uncertainty.py --parts"
    print("all checked")


main()
