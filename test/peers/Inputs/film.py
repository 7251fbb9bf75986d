#!/usr/bin/env python3
"""film.py SCRATCH: writes a path of cameras as videos, compares a decoded frame with the picture, and takes frames from one."""

import os
import re
import sys

from programs import run

scratch = sys.argv[1]
# Chroma of 4:2:0 and quantisation, of pictures this small.
LEAST_DB = 30


def path(name):
    return os.path.join(scratch, name)


def main():
    run("splat", "demo-scene", "-o", path("s.ply"), "--gaussians", "1000")
    # An odd width, which gets one column more.
    run("splat", "render", path("s.ply"), "--orbit", "8", "--size", "159x90", "-o", path("p.png"))
    worst = 1000.0
    for ending in ("mp4", "webm"):
        run("splat", "render", path("s.ply"), "--orbit", "8", "--size", "159x90", "-o", path(f"path.{ending}"), "--frame-rate", "12")
        # What a player does: the matrix and the range that the file says.
        run("ffmpeg", "-v", "error", "-nostdin", "-y", "-i", path(f"path.{ending}"), "-vf", "format=rgb24,crop=159:90:0:0:exact=1", path(f"{ending}-%d.png"))
        frames = [name for name in os.listdir(scratch) if name.startswith(f"{ending}-")]
        if len(frames) != 8:
            sys.exit(f".{ending}: {len(frames)} frames, expected 8")
        for number in range(1, 9):
            said = run("splat", "compare", path(f"p.orbit-{number - 1}.png"), path(f"{ending}-{number}.png"))
            worst = min(worst, float(re.search(r"([\d.]+) dB", said)[1]))
    if worst < LEAST_DB:
        sys.exit(f"{worst} dB, expected {LEAST_DB}")
    version = run("ffmpeg", "-version").split()[2]
    print(f"peer ffmpeg {version}: decodes 8 frames of an .mp4 and of a .webm, at least {worst:.1f} dB beside splat's pictures")


main()
