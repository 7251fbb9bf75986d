#!/usr/bin/env python3
"""Triangles by the clock, beside another rasterizer's RTL and beside Gaussians: docs/rtl.md, docs/meshes.md.

usage: bench/triangles.py traces [FOLDER]
   or: bench/triangles.py frames|accuracy [--width N]
traces: each trace of FOLDER (../shared/data/skybox) at 128x128 by the sample `triangles` on `prototype`, a row each.
frames: a ball of triangles alone, Gaussians alone and both, frames a second on `prototype` and `scaled`.
accuracy: what `splat accuracy` measures of the mesh's knobs, with such a ball that has a texture; Gaussians as in frames."""

import argparse
import json
import math
import os
import random
import struct
import subprocess
import sys
import tempfile

import command_line
import scenes
import study

sys.path.append(os.path.join(scenes.ROOT, "test/Inputs"))
import png_file  # noqa: E402

SAMPLE = os.path.join(scenes.ROOT, "apps/samples/triangles/trace.py")
SKYBOX = os.path.join("..", "shared", "data", "skybox")
# Cycles in which lanes are given pixels or would be; all in which a rasterizer has a command.
LANES = ("blend", "clip", "hazard")
NOT_BUSY = ("idle", "commands", "gaussians", "clipped", "lane_slots")

# A scene, its view, and how far before the camera the middle of the ball is, in the scene's units.
FRAMES = (("demo", "front", 4.0), ("truck", "overview", 1.5), ("garden_outdoor", "path", 3.0))
MACHINES = ("prototype", "scaled")
KNOBS = "subpixel-bits,mesh-depth,filter-bits"
BALL = 100  # circles of latitude; twice as many of longitude


def timed(trace, folder):
    """The clock's report of each run of a trace at 128x128, and the energy of all."""
    stats, picture = os.path.join(folder, "stats.json"), os.path.join(folder, "p.png")
    variables = {"VORION_TIME": "on", "VORION_STATS": stats, "PYOPENCL_NO_CACHE": "1"}
    subprocess.run(["/usr/bin/python3", SAMPLE, trace, picture], check=True, stdout=subprocess.DEVNULL,
                   env={**os.environ, **variables})
    with open(stats, encoding="utf-8") as f:
        return json.load(f)


def slices(folder):
    """Of each trace: pairs of tile and triangle, cycles of the RTL's slice, and fragments."""
    import numpy as np  # only here: Debian's python3 has it, and the other table needs none
    found = {}
    with np.load(os.path.join(folder, "derived", "raster_slice_cycles_128.npz")) as file:
        for trace, row in zip(file["trace"].tolist(), file["values"].tolist(), strict=True):
            of = found.setdefault(trace, {"pairs": 0, "cycles": 0, "fragments": 0})
            of["pairs"] += row[1]
            of["cycles"] += row[2]
    for trace, of in found.items():
        with np.load(os.path.join(folder, "derived", f"{trace}_128.npz")) as file:
            of["fragments"] = int(file["fragments_per_draw"].sum())
        with np.load(os.path.join(folder, "traces", f"{trace}.npz")) as file:
            of["triangles"] = len(file["triangles"])
    return found


def traces(folder):
    print("| trace | triangles | in tiles | pixels | RTL, cycles | lanes | all but `drain` | RTL, pixels a cycle | lanes | "
          "RTL, million triangles in tiles a second | lanes | frame, ms | mJ |")
    print("|---|" + "--:|" * 12)
    with tempfile.TemporaryDirectory() as scratch:
        for trace, of in slices(folder).items():
            stats = timed(os.path.join(folder, "traces", trace + ".npz"), scratch)
            units = [unit for run in stats["runs"] for unit in run["time"]["rasterizers"]]
            lanes = sum(unit[reason] for unit in units for reason in LANES)
            busy = sum(cycles for unit in units for reason, cycles in unit.items() if reason not in NOT_BUSY + ("drain",))
            clock = stats["runs"][0]["time"]["clock_mhz"]
            frame = sum(run["time"]["cycles"] for run in stats["runs"]) / clock / 1e3
            rate = [of["pairs"] * clock / cycles for cycles in (of["cycles"], lanes)]
            print(f"| {trace} | {of['triangles']} | {of['pairs']} | {of['fragments']} | {of['cycles']} | {lanes} | {busy} | "
                  f"{of['fragments'] / of['cycles']:.1f} | {of['fragments'] / lanes:.1f} | {rate[0]:.0f} | {rate[1]:.0f} | "
                  f"{frame:.2f} | {1e3 * stats['energy']['joules']['value']:.2f} |", flush=True)


def write_texture(path):
    """Squares of 4 x 4 random colours, 256 x 128 texels."""
    values, rows = random.Random(1), []
    for _ in range(32):
        colours = [bytes(values.randrange(256) for _ in range(3)) for _ in range(64)]
        rows += [b"".join(4 * colour for colour in colours)] * 4
    png_file.write(path, rows, 3)


def write_ball(path, camera, away, texture=None):
    """An OBJ of a ball of 4 BALL^2 - 4 BALL triangles whose radius is a quarter of its distance. `texture`: the name of a
    picture beside it that is laid around it twice, in the place of colours."""
    middle = [p + away * row[2] for p, row in zip(camera["position"], camera["rotation"], strict=True)]
    radius, around = away / 4, 2 * BALL
    with open(path, "w", encoding="utf-8") as file:
        if texture:
            library = os.path.splitext(path)[0] + ".mtl"
            with open(library, "w", encoding="utf-8") as material:
                material.write(f"newmtl ball\nmap_Kd {texture}\n")
            file.write(f"mtllib {os.path.basename(library)}\nusemtl ball\n")
        for i in range(BALL + 1):
            for j in range(around):
                a, b = math.pi * i / BALL, 2 * math.pi * j / around
                at = (math.sin(a) * math.cos(b), math.cos(a), math.sin(a) * math.sin(b))
                color = "" if texture else " " + " ".join(f"{0.5 + 0.4 * x:.3f}" for x in at)
                file.write("v " + " ".join(f"{m + radius * x:.6f}" for m, x in zip(middle, at, strict=True)) + f"{color}\n")
        if texture:
            file.writelines(f"vt {2 * j / around} {1 - i / BALL}\n" for i in range(BALL + 1) for j in range(around + 1))

        def corner(i, j):
            vertex = f"{i * around + j % around + 1}"
            return f"{vertex}/{i * (around + 1) + j + 1}" if texture else vertex

        for i in range(BALL):
            for j in range(around):
                a, b, c, d = corner(i, j), corner(i, j + 1), corner(i + 1, j + 1), corner(i + 1, j)
                if i:
                    file.write(f"f {a} {b} {c}\n")
                if i != BALL - 1:
                    file.write(f"f {a} {c} {d}\n")


def write_nothing(path, camera):
    """A scene of one Gaussian behind the camera."""
    names = ["x", "y", "z", "f_dc_0", "f_dc_1", "f_dc_2", "opacity", *(f"scale_{k}" for k in range(3)), *(f"rot_{k}" for k in range(4))]
    behind = [p - row[2] for p, row in zip(camera["position"], camera["rotation"], strict=True)]
    head = "\n".join(["ply", "format binary_little_endian 1.0", "element vertex 1", *(f"property float {n}" for n in names), "end_header\n"])
    with open(path, "wb") as file:
        file.write(head.encode() + struct.pack("<14f", *behind, 0, 0, 0, 0, -3, -3, -3, 1, 0, 0, 0))


def demo(folder):
    scene, cameras = os.path.join(folder, "demo.ply"), os.path.join(folder, "demo.json")
    subprocess.run(["splat", "demo-scene", "-o", scene, "--cameras", cameras], check=True, stdout=subprocess.DEVNULL)
    return scenes.Scene("demo", scene, cameras, scenes.views_of(cameras))


def frames(width):
    print("| scene, view | machine | triangles | Gaussians seen | mesh alone | Gaussians alone | both |")
    print("|---|---|--:|--:|--:|--:|--:|")
    with tempfile.TemporaryDirectory() as folder:
        for name, view, away in FRAMES:
            of = demo(folder) if name == "demo" else scenes.shared(name)
            of = scenes.at_width(of, width, folder)
            with open(os.path.join(scenes.ROOT, of.cameras), encoding="utf-8") as file:
                camera = next(c for c in json.load(file) if c["img_name"] == view)
            ball, nothing = os.path.join(folder, f"{name}.obj"), os.path.join(folder, f"{name}.nothing.ply")
            write_ball(ball, camera, away)
            write_nothing(nothing, camera)
            empty = scenes.Scene(name + " empty", nothing, of.cameras, of.views)
            for machine in MACHINES:
                points = [study.render(f"{name} {machine} {what}", scene, view, *mesh, VORION_CONFIG=machine, VORION_TIME="on")
                          for what, scene, mesh in (("mesh", empty, ("--mesh", ball)), ("gaussians", of, ()),
                                                    ("both", of, ("--mesh", ball)))]
                reports = study.reports(points)
                print(f"| {of.name}, {view} | `{machine}` | {reports[0]['mesh']['triangles']} | {reports[1]['counts']['visible']} | " +
                      " | ".join(f"{r['time']['fps']:.1f}" for r in reports) + " |", flush=True)


def accuracy(width):
    with tempfile.TemporaryDirectory() as folder:
        write_texture(os.path.join(folder, "texture.png"))
        for name, view, away in FRAMES[:2]:
            of = demo(folder) if name == "demo" else scenes.shared(name)
            of = scenes.at_width(of, width, folder)
            with open(os.path.join(scenes.ROOT, of.cameras), encoding="utf-8") as file:
                camera = next(c for c in json.load(file) if c["img_name"] == view)
            ball, out = os.path.join(folder, f"{name}.obj"), os.path.join(folder, name)
            write_ball(ball, camera, away, "texture.png")
            subprocess.run(["splat", "accuracy", of.path, "--cameras", of.cameras, "--view", view, "--mesh", ball, "-o", out,
                            "--knobs", KNOBS, "--products", "0", "--no-host"], check=True, cwd=scenes.ROOT, stdout=sys.stderr)
            print(f"\n{name}, {view}, {width} pixels wide:\n", flush=True)
            subprocess.run([sys.executable, os.path.join(scenes.ROOT, "bench/accuracy_table.py"), out + "/accuracy.json"], check=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=("traces", "frames", "accuracy"))
    parser.add_argument("folder", nargs="?", default=os.path.join(scenes.ROOT, SKYBOX))
    parser.add_argument("--width", type=int, default=960, help="of the frames' pictures (960)")
    options = parser.parse_args()
    if options.what == "frames":
        frames(options.width)
    elif options.what == "accuracy":
        accuracy(options.width)
    elif os.path.isdir(options.folder):
        traces(options.folder)
    else:
        sys.exit(f"triangles.py: error: no {options.folder}, expected the traces there")


if __name__ == "__main__":
    command_line.run(main)
