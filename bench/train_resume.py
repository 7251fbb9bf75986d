#!/usr/bin/env python3
"""Kills a training run with SIGKILL at random moments, resumes it each time, and compares with an unbroken run.

usage: train_resume.py CAPTURE [--kills 10] [--seed 1] [--folder build/train-resume] [-- OPTIONS OF splat train ...]

The unbroken run is made once and says how long one takes; each kill comes after a random part of that. Scene and last
checkpoint must be equal byte by byte. Prints each kill; exit code 1 if the results differ.
"""
import argparse
import filecmp
import pathlib
import random
import subprocess
import sys
import time

import command_line


def run(capture, output, options, limit=None):
    """True if the run ended by itself."""
    command = ["splat", "train", capture, "-o", str(output), "--resume", *options]
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    try:
        _, errors = process.communicate(timeout=limit)
    except subprocess.TimeoutExpired:
        process.kill()
        process.communicate()
        return False
    if process.returncode != 0:
        sys.exit(f"train_resume.py: error: splat train ended with {process.returncode}: {errors.decode(errors='replace')[-400:]}")
    return True


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("capture")
    parser.add_argument("--kills", type=int, default=10)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--folder", type=pathlib.Path, default=pathlib.Path("build/train-resume"))
    arguments, options = command_line.parse(parser)
    arguments.folder.mkdir(parents=True, exist_ok=True)
    whole, broken = arguments.folder / "whole.ply", arguments.folder / "broken.ply"
    for output in (whole, broken):
        pathlib.Path(f"{output}.checkpoint").unlink(missing_ok=True)

    start = time.monotonic()
    run(arguments.capture, whole, options)
    seconds = time.monotonic() - start
    print(f"unbroken: {seconds:.1f} s")
    chance = random.Random(arguments.seed)
    kills = 0
    while kills < arguments.kills:
        limit = chance.uniform(0, seconds * 2 / arguments.kills)
        if run(arguments.capture, broken, options, limit):
            break
        kills += 1
        print(f"kill {kills} after {limit:.2f} s")
    run(arguments.capture, broken, options)
    same = all(filecmp.cmp(f"{whole}{end}", f"{broken}{end}", shallow=False) for end in ("", ".checkpoint"))
    print(f"{kills} kills: {'the same bytes' if same else 'other bytes'}")
    return 0 if same else 1


if __name__ == "__main__":
    command_line.run(main)
