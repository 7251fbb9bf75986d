#!/usr/bin/env python3
"""How many frames a second `splat view` draws, where their time goes, and whether it grows.

usage: bench/view.py SCENE CAMERAS [--size WxH] [--minutes M]

Orbits about what the first camera looks at and asks for whole pictures, one after the other, as the page
does. Prints frames a second, the processor time of each, which other programs change less, the mean time of each
stage, and the server's resident memory after a fifth of the time and at its end. Exit codes: 0, 1 the memory
grew by more than 5 %.
"""

import argparse
import http.client
import json
import math
import os
import struct
import subprocess
import time
import urllib.parse

import command_line


def resident(process):
    """MiB."""
    with open(f"/proc/{process.pid}/statm", encoding="ascii") as f:
        return int(f.read().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 2**20


def processor_seconds(process):
    with open(f"/proc/{process.pid}/stat", encoding="ascii") as f:
        return sum(map(int, f.read().rsplit(")", 1)[1].split()[11:13])) / os.sysconf("SC_CLK_TCK")


def turned(camera, size, angle, distance):
    """The camera after an orbit by angle about its own y axis, for a picture of another size."""
    width, height = size
    scale = width / camera["width"]
    rows, c, s = camera["rotation"], math.cos(angle), math.sin(angle)
    right, down, ahead = ([row[k] for row in rows] for k in range(3))
    new_right = [c * r - s * a for r, a in zip(right, ahead)]
    new_ahead = [s * r + c * a for r, a in zip(right, ahead)]
    target = [p + distance * a for p, a in zip(camera["position"], ahead)]
    return {"width": width, "height": height, "fx": camera["fx"] * scale, "fy": camera["fy"] * scale,
            "position": [t - distance * a for t, a in zip(target, new_ahead)],
            "rotation": [list(row) for row in zip(new_right, down, new_ahead)]}


def frame(at, camera):
    """The facts of a picture."""
    connection = http.client.HTTPConnection("127.0.0.1", at.port, timeout=600)
    connection.request("POST", "/frame", json.dumps({"camera": camera}),
                       {"Origin": f"http://{at.netloc}", "X-Splat-Token": at.fragment})
    answer = connection.getresponse()
    body = answer.read()
    assert answer.status == 200, body
    size, = struct.unpack("<I", body[:4])
    return json.loads(body[4:4 + size])


def measure(args, at, process):
    with open(args.cameras, encoding="utf-8") as f:
        camera = json.load(f)[0]
    size = tuple(map(int, args.size.split("x")))
    distance = math.dist(camera["position"], [0, 0, 0])
    frame(at, turned(camera, size, 0, distance))  # compiles the kernels
    worked, begun, count, stages, early = processor_seconds(process), time.monotonic(), 0, {}, None
    while (passed := time.monotonic() - begun) < 60 * args.minutes:
        for stage in frame(at, turned(camera, size, 0.05 * (count + 1), distance))["stages"]:
            stages[stage["name"]] = stages.get(stage["name"], 0) + stage["seconds"]
        count += 1
        if early is None and passed > 12 * args.minutes:
            early = resident(process)
    late = resident(process)
    worked = processor_seconds(process) - worked
    print(f"{count} frames of {args.size}, {count / passed:.2f} a second, {1000 * passed / count:.1f} ms each, "
          f"of a processor {1000 * worked / count:.1f} ms")
    for name, seconds in stages.items():
        print(f"  {name:<14}{1000 * seconds / count:8.1f} ms")
    print(f"  {'the rest':<14}{1000 * (passed - sum(stages.values())) / count:8.1f} ms")
    print(f"resident memory {early:.1f} MiB, at the end {late:.1f} MiB")
    return 0 if late < 1.05 * early else 1


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene")
    parser.add_argument("cameras")
    parser.add_argument("--size", default="480x272")
    parser.add_argument("--minutes", type=float, default=1)
    args = parser.parse_args()
    with subprocess.Popen(["splat", "view", args.scene, "--cameras", args.cameras, "--size", args.size],
                          stdout=subprocess.PIPE, text=True) as process:
        try:
            return measure(args, urllib.parse.urlsplit(process.stdout.readline().split()[-1]), process)
        finally:
            process.terminate()


if __name__ == "__main__":
    command_line.run(main)
