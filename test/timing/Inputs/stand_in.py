#!/usr/bin/env python3
"""Stands in for a program that scripts/validate.sh runs, by the name under which it is called.

As dram_patterns: three patterns and three loads, as bench/timing's program prints them. As dram: a peer that has two of them and the
loads, but one pattern 1 % slower, with a mean of 12 % more at 60 % of the peak, and with 95th percentiles of 30 % more at 60 and at
90 %. As loops: a peer with one loop. As kernels: a peer with one kernel. As l2: our references of the L2, but with a chain of hits
that takes 10 % more, and of another image of gcd. As broken: no JSON.
"""

import hashlib
import json
import os
import sys

TIMING = os.path.join(os.path.dirname(os.path.realpath(__file__)), os.pardir, os.pardir, os.pardir, "bench", "timing")
SPEEDS = {"random_4_to_1": (5.0, 400.0), "stream_write": (6.0, None), "stream_read": (6.1, None)}
LOADS = {10: (80.0, 140.0), 60: (120.0, 300.0), 90: (320.0, 700.0)}
CYCLES = 16300  # of the kernel gcd, about


def dram_patterns():
    return {"closed": {name: {"gb_s": speed, "mean_read_ns": latency} for name, (speed, latency) in SPEEDS.items()},
            "open_per_cent": {str(load): {"mean_read_ns": mean, "read_95_ns": late} for load, (mean, late) in LOADS.items()}}


def dram():
    return {"patterns": [{"name": name, "ramulator": {"gb_s": speed / (1.01 if name == "stream_write" else 1), "mean_read_ns": latency}}
                         for name, (speed, latency) in SPEEDS.items() if name != "stream_read"],
            "open_per_cent": {load: {"ramulator": {"mean_read_ns": mean * (1.12 if load == 60 else 1),
                                                   "read_95_ns": late * (1 if load == 10 else 1.3)}}
                              for load, (mean, late) in LOADS.items()}}


def loops():
    assert os.path.exists(os.path.join(sys.argv[1], "vortex_core_cpi.json"))
    return [{"name": "rtl_2025_09", "results": [{"kernel": "adds_3", "cycles_per_iteration": 21, "comparable": True}]}]


def l2():
    with open(os.path.join(TIMING, "l2_references.json")) as file:
        references = json.load(file)
    references["loops"]["chase_8"]["cycles_per_iteration"] *= 1.1
    references["kernels"][0]["kernels"]["gcd"]["image"] = "another"
    return references


def kernels():
    """It says of an image what it has run, and of a result something else."""
    sys.path.append(TIMING)
    import kernels as ours
    image = ours.hash_of(ours.image_of(os.path.join(sys.argv[1], "gcd.elf")))
    return [{"name": "rtl_2025_09", "preset": "vortex-2025", "warps": 1, "fixed_cycles": 61, "kernels": {
        "gcd": {"image": image, "result": hashlib.sha256(b"").hexdigest()[:16], "cycles": CYCLES}}}]


called = os.path.basename(sys.argv[0])
print("no figures" if called == "broken" else json.dumps({"dram_patterns": dram_patterns, "dram": dram, "loops": loops, "kernels": kernels, "l2": l2}[called]()))
