#!/usr/bin/env python3
"""What a clock on several threads could gain: its processor time by who can notice what it does, from a profile.

usage: clock_serial.py [--config NAME] SCENE --cameras FILE --view NAME

Private is what one core alone notices: its scoreboard, its data cache, its trace. All else, serial, decides what other cores
get, in the order of time: L2, last-level cache, link, DRAM, rasterizers, barriers, and whose turn it is. A window is how long
no core notices what another has asked for: a load's way to the L2 and back, without a store's on the link, which may be
noticed at once. Needs perf. Exit codes: 0, 1 a run failed, 2 usage.
"""
import argparse
import collections
import json
import os
import re
import subprocess
import tempfile

import timed_frame

PRIVATE = re.compile(r"isasim::(CoreClock|DataCache|LineWaits|LinesInFlight|TraceBuffer)\b")
SERIAL = re.compile(r"isasim::(Clock|InstructionCache|Cache|CacheTags|CrossbarCache|MemorySystem|L2Link|DramChannels|dram::|RasterClock|"
                    r"RasterLanes|DispatchTable|GaussianFetch|TileStore|PixelClock|HostUnits)")


def profile(command, folder):
    """Nanoseconds of the process that `command` starts, by symbol."""
    data = os.path.join(folder, "perf.data")
    subprocess.run(["perf", "record", "-q", "-e", "cpu-clock:u", "-F", "2000", "-o", data, "--", *command],
                   check=True, stdout=subprocess.DEVNULL)
    samples = subprocess.run(["perf", "script", "-i", data, "-F", "period,ip,sym"], check=True, capture_output=True, text=True)
    times = collections.Counter()
    for line in samples.stdout.splitlines():
        period, _, symbol = line.split(maxsplit=2)
        times[symbol] += int(period)
    return times


def window(timing):
    """The window in cycles of the chip."""
    l2_mhz = timing["link"]["l2_mhz"] or timing["clock_mhz"]
    ns = timing["link"]["to_l2_ns"] + timing["link"]["from_l2_ns"] + timing["l2"]["hit_cycles"] * 1000 / l2_mhz
    return ns * timing["clock_mhz"] / 1000


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--config", help="a machine; the default one without it")
    timed_frame.add_view(parser)
    args = parser.parse_args()
    if args.config:
        os.environ["VORION_CONFIG"] = args.config
    timing = timed_frame.machine(args.config)["timing"]
    with tempfile.TemporaryDirectory() as folder:
        report = os.path.join(folder, "report.json")
        times = profile(["splat", "render", args.scene, "--cameras", args.cameras, "--view", args.view, "-o",
                         os.path.join(folder, "o.png"), "--time", "--json", report], folder)
        with open(report, encoding="utf-8") as file:
            cycles = json.load(file)["time"]["frame_ms"] * timing["clock_mhz"] * 1000
    private = sum(time for symbol, time in times.items() if PRIVATE.search(symbol))
    serial = sum(time for symbol, time in times.items() if SERIAL.search(symbol))
    share = serial / (private + serial)
    windows = cycles / window(timing)
    print(f"clock {(private + serial) / 1e9:.2f} s of {sum(times.values()) / 1e9:.2f} s of the process")
    print(f"serial {share:.0%}: {1 / share:.2f} times at most, {2 / (1 + share):.2f} on two processors")
    print(f"a window of {window(timing):.0f} cycles has {serial / windows:.0f} ns of serial and {private / windows:.0f} ns of private work")


if __name__ == "__main__":
    main()
