#!/usr/bin/env python3
"""What ideas for the rasterizer would save at most, if they cost nothing: docs/rtl.md, "Ideas, if they were free".

usage: bench/raster_bounds.py FILE...   (each what `isasim-raster-tiles raster-tiles.bin` wrote of a frame)
Prints a table, a column a file, in percent of the cycles of all tiles or of the frame's blending."""

import heapq
import struct
import sys

import command_line

# isasim/testing/RasterTile.h
HEAD = struct.Struct("<32s4If15If")
FIELDS = ("x y width height cutoff gaussians pixels latency fragments blends cycles begin fetch clip blend hazard flush "
          "drain primitive depth clear_depth").split()
LANES, START = 16, 4


def tiles(name):
    with open(name, "rb") as f:
        while head := f.read(HEAD.size):
            if len(head) != HEAD.size:
                sys.exit(f"raster_bounds.py: error: {name}: is cut off, expected what isasim-raster-tiles wrote")
            tile = dict(zip(FIELDS, HEAD.unpack(head)[1:], strict=True))
            record, pixel = (72, 8) if tile["primitive"] else (48, 16)
            f.seek(record * tile["gaussians"] + pixel * tile["pixels"], 1)
            yield tile


def dealt(cycles, rasterizers):
    """Cycles until all are done, where the tiles go, in this order, each to the rasterizer that is free first."""
    busy = [0] * rasterizers
    for one in cycles:
        heapq.heapreplace(busy, busy[0] + one)
    return max(busy)


def rows(frame):
    total = sum(t["cycles"] for t in frame)

    def part(saved):
        return 100 * saved / total

    def of(key):
        return sum(t[key] for t in frame)

    by_list = [t["cycles"] for t in sorted(frame, key=lambda t: -t["gaussians"])]
    by_cycles = sorted((t["cycles"] for t in frame), reverse=True)
    yield "a tile is cleared and written while another blends", part(of("begin") - START * len(frame) + of("drain"))
    yield "no two pixels of a cycle meet in a bank", part(of("blend") - of("fragments") / LANES)
    yield "only pixels that are blended take a lane", part(of("blend") - of("blends") / LANES)
    yield "a pixel's new value is forwarded to its next blend", part(of("hazard"))
    yield "Gaussians that miss the tile take no cycle", part(of("clip"))
    yield "records are always there", part(of("fetch"))
    for count in (2, 16):
        now = dealt(by_list, count)
        yield f"{count} rasterizers: tiles are dealt by their cycles, not by their lists", 100 * (1 - dealt(by_cycles, count) / now)
        yield f"{count} rasterizers: tiles are split until all are equally busy", 100 * (1 - total / count / now)


def main():
    if len(sys.argv) < 2:
        sys.exit("usage: bench/raster_bounds.py FILE...")
    columns = []
    for name in sys.argv[1:]:
        frame = list(tiles(name))
        if not frame:
            sys.exit(f"raster_bounds.py: error: {name}: has no tiles, expected what isasim-raster-tiles wrote")
        columns.append(dict(rows(frame)))
    print("| idea | " + " | ".join(sys.argv[1:]) + " |")
    print("|---|" + "--:|" * len(columns))
    for idea in columns[0]:
        print(f"| {idea} | " + " | ".join(f"{column[idea]:.1f}" for column in columns) + " |")


if __name__ == "__main__":
    command_line.run(main)
