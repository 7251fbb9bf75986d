#!/usr/bin/env python3
"""Checks who drew which tile with --deal last-frame: kernels/deal_last_frame.cl, done anew.

usage: deal.py TILES RASTERIZERS CORES   (VORION_TILES of a sequence; cores of a rasterizer)
Prints, for each picture, tiles and how many of them had a Gaussian.
"""

import json
import struct
import sys


def pictures(name):
    """The tiles of each picture, by the runs of the device."""
    runs = {}
    with open(name, encoding="utf-8") as f:
        for tile in map(json.loads, f):
            runs.setdefault(tile["run"], []).append(tile)
    return [runs[run] for run in sorted(runs)]


def place(tile):
    return tile["y"], tile["x"]


def single(value):
    """Rounded as fp32 is."""
    return struct.unpack("f", struct.pack("f", value))[0]


def deal(tiles, before, rasterizers):
    """The places of each rasterizer's tiles, in order."""
    def work(tile):
        if not tile["list"]:
            return 0
        known = before.get(place(tile))
        if not known or not known["gaussians"]:
            return 8 * tile["list"]
        then = 8 * known["gaussians"] + known["fragments"] // 16 + known["fragments"] // 64
        return max(int(single(single(then * tile["list"]) / known["list"])), 1)

    ranked = sorted(tiles, key=lambda tile: (-work(tile), place(tile)))
    full = [tile for tile in ranked if tile["list"]]
    hands, busy = [[] for _ in range(rasterizers)], [0] * rasterizers
    hand = (rasterizers + 1) // 2
    for first in range(0, len(full), hand):
        less_busy = sorted(range(rasterizers), key=lambda r: (busy[r], r))
        for r, tile in zip(less_busy, full[first:first + hand], strict=False):
            busy[r] += work(tile)
            hands[r].append(place(tile))
    for n, tile in enumerate(ranked[len(full):]):
        hands[n % rasterizers].append(place(tile))
    return hands, len(full)


def main():
    name, rasterizers, cores = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
    before = {}
    for number, tiles in enumerate(pictures(name)):
        hands, full = deal(tiles, before, rasterizers)
        expected = {at: (r * cores + row % cores) for r, hand in enumerate(hands) for row, at in enumerate(hand)}
        for tile in tiles:
            if tile["core"] != expected[place(tile)]:
                sys.exit(f"deal.py: picture {number}: core {tile['core']} drew tile {place(tile)}, expected core {expected[place(tile)]}")
        print(f"picture {number}: {len(tiles)} tiles, {full} of them with a Gaussian")
        before = {place(tile): tile for tile in tiles}


if __name__ == "__main__":
    main()
