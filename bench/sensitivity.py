#!/usr/bin/env python3
"""How much each parameter of the clock carries: a frame with every parameter 20 % lower and 20 % higher.

usage: sensitivity.py SCENE --cameras FILE --view NAME --out FOLDER [--config FILE] [--share PERCENT] [--only PREFIX]

Parameters are those of the configuration's "timing" object (vorion-sim --print-default-config), as isasim/include/
vorion/isasim/TimingParams.def lists them; a switch is turned over instead, what must be a power of two is halved and doubled,
and what there is none of is left out. The table is printed as Markdown, largest effect first. FOLDER keeps each frame
(docs/studies.md).
"""

import argparse
import json

import clocked
import command_line
import study
import timed_frame

SWITCHES = ("fpu", "loads_queue", "interleaved_stacks", "intersect_hint", "crossbar", "write_through")
POWERS_OF_TWO = ("channels", "channel_bytes")
# Of these 0 is no number but none, or no bound, and 1 is far from it.
NONE_IF_ZERO = ("constant_cycles", "dcache_kib", "fixed_cycles", "fp_in_flight", "from_l2_mbps", "icache_kib", "l2_mhz", "register_banks",
                "skip_blocks", "tile_overlap", "to_l2_mbps", "unit_queue")


def parameters(timing):
    """(group, name, default) of every parameter."""
    for group, members in timing.items():
        if isinstance(members, dict):
            for name, value in members.items():
                if not isinstance(value, str):
                    yield group, name, value


def variants(name, value):
    """What to try: value by label."""
    if name in SWITCHES:
        return {"other": 1 - value}
    if name in POWERS_OF_TWO:
        return {"half": value // 2, "twice": 2 * value}
    if value == 0 and name in NONE_IF_ZERO:
        return {}
    step = max(1, round(0.2 * value))
    return {"-20 %": max(0, value - step), "+20 %": value + step}


def points_of(args, default):
    """(key, default value, label, point) of each machine that is tried; the first is the machine as it is."""
    of = timed_frame.scene_of(args)

    def point(name, config):
        return study.render(name, of, args.view, "--time", may_be_refused=name != "base",
                            VORION_CONFIG=json.dumps(config))

    yield None, None, None, point("base", default)
    for group, name, value in parameters(default["timing"]):
        key = f"{group}.{name}"
        # Launches and copies are added outside of the run's cycles.
        if group == "host" or not key.startswith(args.only):
            continue
        for label, tried in variants(name, value).items():
            if tried != value:
                config = json.loads(json.dumps(default))
                config["timing"][group][name] = tried
                yield key, value, label, point(f"{key}={tried}", config)


def table(tried, share):
    """tried: (key, default, label, time or None) with the machine as it is in front."""
    base, found = tried[0][3]["sum"], {}
    for key, default, label, time in tried[1:]:
        if time:
            found.setdefault((key, default), {})[label] = 100 * (time["sum"]["cycles"] / base["cycles"] - 1)
    rows = [(max(map(abs, changes.values())), key, default, changes) for (key, default), changes in found.items()]
    rows.sort(key=lambda row: (-row[0], row[1]))
    print(f"frame: {base['cycles']} cycles of {clocked.name(base)}\n")
    print("| parameter | default | 20 % less | 20 % more |\n|---|--:|--:|--:|")
    small = 0
    for effect, key, default, changes in rows:
        if effect < share:
            small += 1
            continue
        less = changes.get("-20 %", changes.get("half", changes.get("other")))
        more = changes.get("+20 %", changes.get("twice", changes.get("other")))
        print(f"| `{key}` | {default} | " + " | ".join("" if c is None else f"{c:+.2f} %" for c in (less, more)) + " |")
    print(f"\n{small} more parameters change the frame by less than {share} %.")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    timed_frame.add_view(parser)
    parser.add_argument("--out", required=True, help="folder for the frames")
    parser.add_argument("--jobs", type=int, default=1, help="frames that are drawn at the same time (default: %(default)s)")
    parser.add_argument("--config", help="a machine's name or file; default: the default machine")
    parser.add_argument("--share", type=float, default=0.1, help="leave out what changes less, in percent")
    parser.add_argument("--only", default="", help="only parameters whose group.name begins so")
    args = parser.parse_args()

    *tried, points = zip(*points_of(args, timed_frame.machine(args.config)))
    times = [result.get("report", {}).get("time") for result in study.measure(points, args.out, args.jobs)]
    table(list(zip(*tried, times)), args.share)


if __name__ == "__main__":
    command_line.run(main)
