#!/usr/bin/env python3
"""What each method of training costs and gives beside the classic one, as the tables of docs/tables/training.md.

usage: bench/training_methods.py CAPTURE --results FOLDER [--seeds N] [--iterations N] [--only METHOD]... [-- OPTIONS]

Trains CAPTURE with each method and seed, as OPTIONS of splat train say. Cycles are of the default machine's clock: the
third iteration, before which no method has changed the number of Gaussians. One result a file in FOLDER, which is
kept: what is there is not made again.
"""

import argparse
import json
import os
import statistics
import subprocess

import command_line

METHODS = {
    "classic": [],
    "MCMC, the same start": ["--preset", "mcmc", "--start-opacity", "0.1", "--start-scale", "1"],
    "antialiased": ["--antialiased"],
    "random background": ["--random-background"],
    "exposure": ["--exposure-rate", "0.01"],
    "poses": ["--pose-rate", "1e-5"],
    "depths of points": ["--depth-weight", "0.01"],
    "cores alone": ["--path", "simt"],
    "cores alone, absolute gradients": ["--path", "simt", "--absgrad", "--densify-gradient", "8e-4"],
}


def run(args, name, seed, more):
    """The report of a run."""
    label = "-".join([name.replace(",", "").replace(" ", "-"), str(seed), *(["cost"] if "--time" in more else [])])
    report = os.path.join(args.results, f"{label}.json")
    if not os.path.exists(report):
        subprocess.run(["splat", "train", args.capture, "-o", os.path.join(args.results, "scene.ply"), "--seed", str(seed),
                        "--checkpoint", os.devnull, "--json", report, *METHODS[name], *more, *args.options],
                       check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    with open(report, encoding="utf-8") as f:
        return json.load(f)


def cost(args, name):
    """Cycles of the third iteration."""
    report = run(args, name, 0, ["--iterations", "3", "--time", "--time-every", "1"])
    return report["timed"][-1]["time"]["sum"]["cycles"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("capture")
    parser.add_argument("--results", required=True)
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--iterations", type=int, default=400, help="0: cycles alone")
    parser.add_argument("--only", action="append", choices=METHODS)
    parser.add_argument("options", nargs="*")
    args = parser.parse_intermixed_args()
    os.makedirs(args.results, exist_ok=True)
    base = None
    print("| method | PSNR, dB, by seed | mean | Gaussians | cycles of an iteration | more |\n|---|---|--:|--:|--:|--:|")
    for name in args.only or METHODS:
        found = [run(args, name, seed, ["--iterations", str(args.iterations)])
                 for seed in range(args.seeds if args.iterations else 0)]
        cycles = cost(args, name)
        base = base or cycles
        scores = [report["psnr8_db"] for report in found]
        print(f"| {name} | {', '.join(f'{s:.2f}' for s in scores)} | {f'{statistics.mean(scores):.2f}' if scores else ''} | "
              f"{found[0]['gaussians'] if found else ''} | {cycles:,} | {100 * cycles / base - 100:+.1f} % |", flush=True)
    return 0


if __name__ == "__main__":
    command_line.run(main)
