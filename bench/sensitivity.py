#!/usr/bin/env python3
"""How much each parameter of the clock carries: a frame with every parameter 20 % lower and 20 % higher.

usage: sensitivity.py SCENE --cameras FILE --view NAME -o OUT.json [--config FILE] [--share PERCENT] [--only PREFIX]

Parameters are those of the configuration's "timing" object (vorion-sim --print-default-config), as isasim/include/
vorion/isasim/TimingParams.def lists them; a switch is turned over instead, what must
be a power of two is halved and doubled, and what there is none of is left out. OUT.json keeps every result, so that a run
that was broken off goes on where it stopped, unless it was made from other things. The table is printed as Markdown, largest effect first.
"""

import argparse
import json
import os
import sys
import tempfile

import clocked
import command_line
import kept
import timed_frame

SWITCHES = ("fpu", "loads_queue", "interleaved_stacks", "intersect_hint")
POWERS_OF_TWO = ("channels", "channel_bytes")
# Of these 0 is no number but none, or no bound, and 1 is far from it.
NONE_IF_ZERO = ("dcache_kib", "fixed_cycles", "fp_in_flight", "from_l2_mbps", "icache_kib", "l2_mhz", "register_banks", "skip_blocks", "tile_overlap",
                "to_l2_mbps", "unit_queue")


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


def frame(args, config, folder):
    """The frame's cycles with a configuration, or the error's text."""
    time = timed_frame.render(args, config, folder)
    if "error" in time:
        return time
    return {"machine": clocked.name(time["sum"]), "cycles": time["sum"]["cycles"],
            "stages": {s["name"]: s["time"]["cycles"] for s in time["stages"] if "time" in s}}


def table(results, share):
    base = results["base"]["cycles"]
    rows = []
    for key, by_label in results["parameters"].items():
        changes = {label: 100 * (r["cycles"] / base - 1) for label, r in by_label.items()
                   if isinstance(r, dict) and "cycles" in r}
        if changes:
            rows.append((max(abs(c) for c in changes.values()), key, by_label, changes))
    rows.sort(key=lambda row: (-row[0], row[1]))
    print(f"frame: {base} cycles of {results['base']['machine']}\n")
    print("| parameter | default | 20 % less | 20 % more |\n|---|--:|--:|--:|")
    small = 0
    for effect, key, by_label, changes in rows:
        if effect < share:
            small += 1
            continue
        less = changes.get("-20 %", changes.get("half", changes.get("other")))
        more = changes.get("+20 %", changes.get("twice", changes.get("other")))
        default = by_label["default"]
        print(f"| `{key}` | {default} | " + " | ".join("" if c is None else f"{c:+.2f} %" for c in (less, more)) + " |")
    print(f"\n{small} more parameters change the frame by less than {share} %.")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    timed_frame.add_view(parser)
    parser.add_argument("-o", "--output", required=True)
    parser.add_argument("--config", help="a machine's name or file; default: the default machine")
    parser.add_argument("--share", type=float, default=0.1, help="leave out what changes less, in percent")
    parser.add_argument("--only", default="", help="only parameters whose group.name begins so")
    args = parser.parse_args()

    default = timed_frame.machine(args.config)
    made_from = kept.origin({"scene": os.path.abspath(args.scene), "cameras": os.path.abspath(args.cameras)},
                            ["--view", args.view, json.dumps(default)])
    results = {"made_from": made_from, "parameters": {}}
    if os.path.exists(args.output):
        with open(args.output) as file:
            had = json.load(file)
        if kept.differences(had.get("made_from"), made_from):
            kept.say_stale(args.output, had.get("made_from"), made_from)
        else:
            results = had

    def keep():
        with open(args.output + ".new", "w") as file:
            json.dump(results, file, indent=1)
        os.replace(args.output + ".new", args.output)

    with tempfile.TemporaryDirectory() as folder:
        if "base" not in results:
            results["base"] = frame(args, default, folder)
            if "error" in results["base"]:
                sys.exit("sensitivity.py: error: " + results["base"]["error"])
            keep()
        for group, name, value in parameters(default["timing"]):
            key = f"{group}.{name}"
            # Launches and copies are added outside of the run's cycles.
            if group == "host" or not key.startswith(args.only):
                continue
            tries = results["parameters"].setdefault(key, {"default": value})
            for label, tried in variants(name, value).items():
                if label in tries or tried == value:
                    continue
                config = json.loads(json.dumps(default))
                config["timing"][group][name] = tried
                tries[label] = frame(args, config, folder)
                keep()
    table(results, args.share)


if __name__ == "__main__":
    command_line.run(main)
