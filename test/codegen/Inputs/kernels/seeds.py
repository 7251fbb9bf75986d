"""Checks many seeds, several at a time; remembers those that were good, so that a long run goes on after an interruption."""

import argparse
import collections
import concurrent.futures
import glob
import hashlib
import json
import os
import resource
import shutil
import sys
import time

from machines import FOLDER, ROOT


def options(description, name, unit):
    """The command line that the random sources share."""
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=100, help=f"{unit} to check (default: 100)")
    parser.add_argument("--first", type=int, default=1, help="first seed")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--folder", default=os.path.join(ROOT, "build", name), help=f"for files and results (build/{name})")
    parser.add_argument("--resume", action="store_true", help="take over what the folder says about seeds that were good")
    parser.add_argument("--quiet", action="store_true", help="no progress")
    return parser


def version():
    """Of the sources here, those of the program that runs, the two tools and the platform that compiles OpenCL C: with others,
    earlier results mean nothing."""
    digest = hashlib.sha256()
    for folder in sorted({FOLDER, os.path.dirname(os.path.abspath(sys.argv[0]))}):
        for path in sorted(glob.glob(os.path.join(folder, "*.[hp]*"))):
            with open(path, "rb") as file:
                digest.update(file.read())
    programs = []
    for tool in ("vorion-clang", "vorion-sim"):
        path = shutil.which(tool)
        if not path:
            sys.exit(f"{os.path.basename(sys.argv[0])}: error: {tool} is not on the path, expected . scripts/env.sh")
        programs.append(path)
    root = os.path.dirname(os.path.dirname(os.path.realpath(programs[0])))
    programs += sorted(glob.glob(os.path.join(root, "pocl", "lib", "libvorion-pocl.so*")))
    for path in programs:
        digest.update(str(os.stat(path).st_size).encode() + str(os.stat(path).st_mtime_ns).encode())
    return digest.hexdigest()


def earlier(ledger, this_version):
    """Seeds that were good, by seed."""
    if not os.path.exists(ledger):
        return {}
    with open(ledger, encoding="utf-8") as file:
        lines = [json.loads(line) for line in file if line.endswith("}\n")]
    if not lines or lines[0].get("version") != this_version:
        sys.exit(f"{os.path.basename(sys.argv[0])}: error: {ledger}: of another compiler, simulator or generator, "
                 "expected a run without --resume")
    return {line["seed"]: line for line in lines[1:] if not line["bad"]}


def check_all(chosen, seeds, check):
    """check(seed, folder) gives {"seed", "counts": {text: number}, "bad": [lines]} and is called in processes of its own.
    Prints bad lines as they come; returns the sum of the counts, the number of bad seeds, and in words how much time the
    processor took for all of them, also for those of earlier runs. A bad seed's files stay."""
    os.makedirs(chosen.folder, exist_ok=True)
    ledger = os.path.join(chosen.folder, "results.jsonl")
    this_version = version()
    done = earlier(ledger, this_version) if chosen.resume else {}
    counts, bad, spent, start = collections.Counter(), 0, 0.0, time.monotonic()
    with open(ledger, "a" if done else "w", encoding="utf-8") as file, \
            concurrent.futures.ProcessPoolExecutor(chosen.jobs) as pool:
        if not done:
            file.write(json.dumps({"version": this_version}) + "\n")
        running = {pool.submit(one, check, seed, chosen.folder) for seed in seeds if seed not in done}
        for result in done.values():
            if result["seed"] in seeds:
                counts.update(result["counts"])
                spent += result["seconds"]
        for number, finished in enumerate(concurrent.futures.as_completed(running), 1):
            result = finished.result()
            file.write(json.dumps(result) + "\n")
            file.flush()
            counts.update(result["counts"])
            bad += bool(result["bad"])
            spent += result["seconds"]
            for line in result["bad"]:
                print(f"seed {result['seed']}: {line}", flush=True)
            if not chosen.quiet and number % 10 == 0:
                print(f"{number + len(seeds) - len(running)} of {len(seeds)} seeds, {bad} bad, {time.monotonic() - start:.0f} s",
                      file=sys.stderr)
    return counts, bad, f"{spent:.0f} s of processor time"


def processor_seconds():
    """Of this process and all that it has waited for."""
    return sum(sum(resource.getrusage(who)[:2]) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))


def one(check, seed, folder):
    """In a folder of the seed's own, which goes if all is good."""
    own = os.path.join(folder, f"seed-{seed}")
    os.makedirs(own, exist_ok=True)
    start = processor_seconds()
    result = check(seed, own)
    result["seconds"] = round(processor_seconds() - start, 2)
    if result["bad"]:
        result["bad"].append(f"files: {own}")
    else:
        shutil.rmtree(own)
    return result
