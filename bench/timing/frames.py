#!/usr/bin/env python3
"""Cycles of a frame with each DRAM standard and each address map, as Markdown tables.

usage: frames.py SCENE CAMERAS VIEW [--machine scaled]

A standard has as many channels as come nearest to the bandwidth of the machine's own. The maps are tried with the machine's
standard. The pictures must be the same to the bit: the exit code is 1 if one differs.
"""

import argparse
import hashlib
import json
import os
import subprocess
import sys
import tempfile

# GB/s of a channel, as docs/dram.md has them.
STANDARDS = {"lpddr4-3200": 6.4, "ddr3-1600": 12.8, "ddr4-3200": 25.6, "lpddr5-6400": 12.8, "hbm2e": 25.6}
MAPS = ("digit_sum", "row_bank_column", "xor")
CHANNEL_BYTES = (64, 256, 1024, 4096)


def frame(args, folder, changes):
    """(time report, hash of the picture) of a frame on the machine with what is changed."""
    picture, report = os.path.join(folder, "frame.pfm"), os.path.join(folder, "frame.json")
    settings = ",".join([f"machine={args.machine}", *(f"timing.dram.{key}={value}" for key, value in changes.items())])
    subprocess.run(["splat", "render", args.scene, "--cameras", args.cameras, "--view", args.view,
                    "-o", picture, "--time", "--json", report], check=True, stdout=subprocess.DEVNULL,
                   env={**os.environ, "VORION_SET": settings})
    with open(picture, "rb") as file:
        shown = hashlib.sha256(file.read()).hexdigest()
    with open(report) as file:
        return json.load(file)["time"]["sum"], shown


def print_table(args, folder, columns, rows, default, picture):
    """A row for each of (what its first columns say, what is changed); whether all pictures are the same."""
    print("| " + " | ".join([*columns, "Mcycles", "against the machine's", "accesses that find their row"]) + " |")
    print("|---" * len(columns) + "|--:|--:|--:|", flush=True)
    same = True
    for cells, changes in rows:
        time, shown = frame(args, folder, changes)
        dram = time["dram"]
        accesses = sum(dram[kind] for kind in ("row_hits", "row_misses", "row_conflicts"))
        print("| " + " | ".join([*cells, f"{time['cycles'] / 1e6:.3f}", f"{time['cycles'] / default - 1:+.1%}",
                                 f"{dram['row_hits'] / accesses:.0%}"]) + " |", flush=True)
        same &= shown == picture
    return same


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name in ("scene", "cameras", "view"):
        parser.add_argument(name)
    parser.add_argument("--machine", default="scaled", help="machine (default: scaled)")
    parser.add_argument("--standard", choices=STANDARDS, default="lpddr4-3200", help="the machine's (default: lpddr4-3200)")
    parser.add_argument("--channels", type=int, default=8, help="the machine's (default: 8)")
    args = parser.parse_args()
    peak = STANDARDS[args.standard] * args.channels
    standards = [((name, str(channels)), {"standard": name, "channels": channels})
                 for name, each in STANDARDS.items() for channels in [max(1, round(peak / each))]]
    maps = [((name, str(size)), {"address_map": name, "channel_bytes": size}) for size in CHANNEL_BYTES for name in MAPS]
    with tempfile.TemporaryDirectory() as folder:
        first, picture = frame(args, folder, {})
        same = print_table(args, folder, ("standard", "channels"), standards, first["cycles"], picture)
        print()
        same &= print_table(args, folder, ("map", "bytes a channel"), maps, first["cycles"], picture)
    if not same:
        print("frames.py: error: pictures differ, expected the same bits with every memory", file=sys.stderr)
    return 0 if same else 1


if __name__ == "__main__":
    sys.exit(main())
