#!/usr/bin/env python3
"""Cycles of a frame with each DRAM standard and each address map, as Markdown tables.

usage: bench/dram_frames.py SCENE --cameras FILE --view NAME [--config MACHINE]

A standard has as many channels as come nearest to the bandwidth of the machine's own. The maps are tried with the machine's
standard. The pictures must be the same to the bit. Exit codes: 0, 1 a frame failed or pictures differ.
"""

import argparse
import glob
import json
import os
import sys

import clocked
import command_line
import study
import timed_frame

TABLES = os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, "isasim", "timing", "dram", "standards")
FOR_VALIDATION = "ramulator-lpddr4"
MAPS = ("digit_sum", "row_bank_column", "xor")
CHANNEL_BYTES = (64, 256, 1024, 4096)


def bandwidths():
    """Bytes a channel moves in a picosecond, by standard."""
    found = {}
    for path in sorted(glob.glob(os.path.join(TABLES, "*.json"))):
        with open(path, encoding="utf-8") as file:
            table = json.load(file)
        found[table["standard"]] = table["burst_bytes"] / (table["values"]["nBL"][0] * table["tick_ps"])
    return found


def point(args, machine, changes):
    """The frame on the machine with what is changed in its DRAM."""
    config = json.loads(json.dumps(machine))
    config["timing"]["dram"].update(changes)
    return study.render(json.dumps(changes), timed_frame.scene_of(args), args.view, "--time", VORION_CONFIG=json.dumps(config))


def print_table(columns, rows, found, default):
    """A row for each of (what its first columns say, what is changed); whether all pictures are the default's; found: the
    reports of the rows."""
    print("| " + " | ".join([*columns, "Mcycles", "against the machine's", "accesses that find their row"]) + " |")
    print("|---" * len(columns) + "|--:|--:|--:|")
    same = True
    for (cells, _), report in zip(rows, found, strict=True):
        time = report["time"]["sum"]
        dram = time["dram"]
        accesses = sum(dram[kind] for kind in ("row_hits", "row_misses", "row_conflicts"))
        print("| " + " | ".join([*cells, f"{time['cycles'] / 1e6:.3f}", f"{time['cycles'] / default['time']['sum']['cycles'] - 1:+.1%}",
                                 f"{dram['row_hits'] / accesses:.0%}"]) + " |")
        same &= report["result_fnv1a64"] == default["result_fnv1a64"]
    return same


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    timed_frame.add_view(parser)
    parser.add_argument("--config", default="scaled", help="a machine's name or file (default: scaled)")
    args = parser.parse_args()
    machine = timed_frame.machine(args.config)
    own, each = machine["timing"]["dram"], bandwidths()
    peak = each[own["standard"]] * own["channels"]
    standards = [((name, str(channels)), {"standard": name, "channels": channels})
                 for name in sorted(each, key=lambda name: name != own["standard"])  # the machine's own first
                 if name != FOR_VALIDATION
                 for channels in [max(1, round(peak / each[name]))]]
    maps = [((name, str(size)), {"address_map": name, "channel_bytes": size}) for size in CHANNEL_BYTES for name in MAPS]
    default, *found = study.reports([point(args, machine, changes) for _, changes in [((), {}), *standards, *maps]])
    same = print_table(("standard", "channels"), standards, found[:len(standards)], default)
    print()
    same &= print_table(("map", "bytes a channel"), maps, found[len(standards):], default)
    clocked.say([clocked.name(default["time"]["sum"])])
    if not same:
        print("dram_frames.py: error: pictures differ, expected the same bits with every memory", file=sys.stderr)
    return 0 if same else 1


if __name__ == "__main__":
    command_line.run(main)
