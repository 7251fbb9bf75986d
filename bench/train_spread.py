#!/usr/bin/env python3
"""How far rounding alone takes a training run: runs on both paths that differ in the last bit of one number.

usage: train_spread.py CAPTURE [--runs 3] [--iterations 1000] [--paths raster,simt] [--folder build/train-spread]
       [-- OPTIONS OF splat train ...]

After iteration 1 of run k > 0 the lowest bit of the x of Gaussian k is flipped in the checkpoint; run 0 is left alone. Prints the
held-out views' PSNR of every run, and of each path the mean, the standard deviation of a run and the standard error of the mean.
What paths differ by beyond that is not rounding's. Runs that were made are not made again; a broken one goes on.
"""
import argparse
import json
import os
import pathlib
import statistics
import struct
import subprocess
import sys

import command_line
import study


def fnv1a64(data):
    value = 0xCBF29CE484222325
    for byte in data:
        value = (value ^ byte) * 0x100000001B3 & 0xFFFFFFFFFFFFFFFF
    return f"{value:016x}"


def flipped(checkpoint, gaussian):
    """A checkpoint with the lowest bit of the first number (the mean's x) of a Gaussian flipped."""
    first, header, body = checkpoint.split(b"\n", 2)
    magic, version, _ = first.split()
    at = 4 * gaussian
    number = struct.unpack_from("<I", body, at)[0] ^ 1
    data = header + b"\n" + body[:at] + struct.pack("<I", number) + body[at + 4 :]
    return b" ".join([magic, version, fnv1a64(data).encode()]) + b"\n" + data


def train(capture, output, iterations, options):
    command = ["splat", "train", capture, "-o", str(output), "--resume", "--checkpoint-every", "100"]
    command += ["--iterations", str(iterations), "--json", f"{output}.json", *options]
    done = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, check=False)
    if done.returncode != 0:
        sys.exit(f"train_spread.py: error: splat train ended with {done.returncode}: {done.stderr.decode(errors='replace')[-400:]}")
    return json.loads(pathlib.Path(f"{output}.json").read_text())


def begun(arguments, path, options):
    """A checkpoint after one iteration, which all runs of the path begin with. Ends the script if the folder's runs began with
    another one."""
    words = ("splat", "train", "{capture}", "-o", "{out}.ply", "--checkpoint", "{out}.checkpoint", "--iterations", "1", "--json",
             "{out}.json", *options, "--path", path)
    start = study.Point(f"{path}-start", words, {"capture": os.path.abspath(arguments.capture)}, keep=(".checkpoint",))
    result, = study.measure([start], arguments.folder)
    asked, of = result["made_from"], arguments.folder / f"{path}-asked.json"
    had = json.loads(of.read_text()) if of.exists() else asked
    if other := [name for name in asked if had.get(name) != asked[name]]:
        sys.exit(f"train_spread.py: error: {of}: runs of other {', '.join(other)}, expected the same or another --folder")
    of.write_text(json.dumps(asked))
    return pathlib.Path(study.file_of(arguments.folder, start, ".checkpoint")).read_bytes()


def parted(losses, others, relative):
    """The first iteration whose losses differ by more than this, from 1; none: 0."""
    return next((i for i, (a, b) in enumerate(zip(losses, others), 1) if abs(a - b) > relative * abs(b)), 0)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("capture")
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--iterations", type=int, default=1000)
    parser.add_argument("--paths", default="raster,simt")
    parser.add_argument("--folder", type=pathlib.Path, default=pathlib.Path("build/train-spread"))
    arguments, options = command_line.parse(parser)
    arguments.folder.mkdir(parents=True, exist_ok=True)
    first = None
    for path in arguments.paths.split(","):
        scores = []
        start = begun(arguments, path, options)
        for run in range(arguments.runs):
            output = arguments.folder / f"{path}-{run}.ply"
            checkpoint = pathlib.Path(f"{output}.checkpoint")
            if not checkpoint.exists():
                aside = pathlib.Path(f"{output}.begun")
                aside.write_bytes(flipped(start, run) if run > 0 else start)
                aside.rename(checkpoint)
            result = pathlib.Path(f"{output}.json")
            if not result.exists() or json.loads(result.read_text())["iterations"] < arguments.iterations:
                train(arguments.capture, output, arguments.iterations, [*options, "--path", path])
            report = json.loads(result.read_text())
            if report["iterations"] != arguments.iterations or report["psnr8_db"] is None:
                sys.exit(f"train_spread.py: error: {result}: expected {arguments.iterations} iterations and held-out views")
            first = first or report
            scores.append(report["psnr8_db"])
            where = [parted(report["losses"], first["losses"], r) for r in (1e-6, 1e-3)]
            print(f"{path} run {run}: {scores[-1]:.3f} dB, {report['gaussians']} Gaussians; losses part from the first run's "
                  f"by 1e-6 at iteration {where[0] or '-'}, by 1e-3 at {where[1] or '-'}", flush=True)
        spread = statistics.stdev(scores) if len(scores) > 1 else float("nan")
        print(f"{path}: mean {statistics.fmean(scores):.3f} dB, a run's standard deviation {spread:.3f} dB, "
              f"the mean's standard error {spread / len(scores) ** 0.5:.3f} dB", flush=True)
    return 0


if __name__ == "__main__":
    command_line.run(main)
