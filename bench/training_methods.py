#!/usr/bin/env python3
"""What each method of training costs and gives beside the classic one, as the tables of docs/tables/training.md.

usage: bench/training_methods.py CAPTURE --results FOLDER [--seeds N] [--iterations N] [--only METHOD]... [-- OPTIONS]

Trains CAPTURE with each method and seed, as OPTIONS of splat train say. Cycles are of the default machine's clock: the mean
of the iterations of seed 0 that --time-every times, and the third iteration, before which no method has changed the number of
Gaussians. Seconds are of the processor, for a run without the clock: the median of the seeds. FOLDER keeps each
run's result (docs/studies.md).
"""

import argparse
import os
import statistics

import clocked
import command_line
import study

METHODS = {
    "classic": [],
    "MCMC, its own start": ["--preset", "mcmc"],
    "MCMC, the classic start": ["--preset", "mcmc", "--start-opacity", "0.1", "--start-scale", "1"],
    "antialiased": ["--antialiased"],
    "random background": ["--random-background"],
    "exposures": ["--exposure-rate", "0.01"],
    "poses": ["--pose-rate", "1e-5"],
    "depths of points": ["--depth-weight", "0.01"],
    "cores alone": ["--path", "simt"],
    "cores alone, absolute gradients": ["--path", "simt", "--absgrad", "--densify-gradient", "8e-4"],
}


def point(args, name, seed, more):
    words = [name.replace(",", "").replace(" ", "-"), str(seed), *(word.strip("-") for word in more)]
    command = ("splat", "train", "{capture}", "-o", "{out}.ply", "--seed", str(seed), "--checkpoint", os.devnull, "--json",
               "{out}.json", *METHODS[name], *more, *args.options)
    return study.Point("-".join(words), command, {"capture": os.path.abspath(args.capture)})


def cycles_of(report):
    """Of each iteration that was timed."""
    return [timed["time"]["sum"]["cycles"] for timed in report["timed"]]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("capture")
    parser.add_argument("--results", required=True)
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--iterations", type=int, default=400, help="0: the third iteration's cycles alone")
    parser.add_argument("--time-every", type=int, default=100)
    parser.add_argument("--only", action="append", choices=METHODS)
    parser.add_argument("options", nargs="*")
    args = parser.parse_intermixed_args()
    base, names = None, []
    print("| method | PSNR, dB, by seed | mean | Gaussians | million cycles | seconds | cycles of the third iteration | more |\n"
          "|---|---|--:|--:|--:|--:|--:|--:|")
    for name in args.only or METHODS:
        first, = study.measure([point(args, name, 0, ["--iterations", "3", "--time", "--time-every", "1"])], args.results)
        short = first["report"]
        names += [clocked.name(timed["time"]["sum"]) for timed in short["timed"]]
        third = cycles_of(short)[-1]
        base = base or third
        cells = [""] * 5
        if args.iterations:
            length = ["--iterations", str(args.iterations)]
            *results, last = study.measure([*(point(args, name, seed, length) for seed in range(args.seeds)),
                                            point(args, name, 0, [*length, "--time", "--time-every", str(args.time_every)])], args.results)
            found = [result["report"] for result in results]
            timed, scores = cycles_of(last["report"]), [report["psnr8_db"] for report in found]
            cells = [", ".join(f"{score:.2f}" for score in scores), f"{statistics.mean(scores):.2f}", f"{found[0]['gaussians']:,}",
                     f"{statistics.mean(timed) / 1e6:.2f}", f"{statistics.median(each['processor_seconds'] for each in results):.1f}"]
        print(f"| {name} | {' | '.join(cells)} | {third:,} | {100 * third / base - 100:+.1f} % |", flush=True)
    clocked.say(names)
    return 0


if __name__ == "__main__":
    command_line.run(main)
