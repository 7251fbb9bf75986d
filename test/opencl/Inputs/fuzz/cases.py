"""What the fuzzers of this folder share: their options, seeds that go on, and
processes that are watched."""

import argparse
import os
import subprocess
import time


def options(description):
    """The parser that every fuzzer starts from."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("--count", type=int, default=1000, help="cases (default: 1000)")
    parser.add_argument("--first", type=int, default=1, help="the first seed (default: 1)")
    parser.add_argument("--seconds", type=float, default=1e9, help="stop after so long")
    parser.add_argument("--resume", action="store_true",
                        help="go on behind the last seed that FOLDER knows of")
    parser.add_argument("--folder", required=True, help="for files; finds stay there")
    return parser


def run(command, seconds=120, **others):
    """(exit code, standard output and error together); negative for a signal,
    None for what took too long."""
    try:
        done = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, timeout=seconds, **others)
        return done.returncode, done.stdout.decode(errors="replace")
    except subprocess.TimeoutExpired as late:
        return None, (late.stdout or b"").decode(errors="replace")


def each(arguments, case):
    """Calls case(seed), which gives what is wrong or "", for the seeds asked
    for. Prints finds and counts; gives the exit code."""
    os.makedirs(arguments.folder, exist_ok=True)
    last = os.path.join(arguments.folder, "last-seed")
    seed = arguments.first
    if arguments.resume and os.path.exists(last):
        with open(last) as file:
            seed = int(file.read()) + 1
    start, done, finds = time.monotonic(), 0, 0
    while seed < arguments.first + arguments.count and time.monotonic() - start < arguments.seconds:
        wrong = case(seed)
        if wrong:
            finds += 1
            print(f"seed {seed}: {wrong}", flush=True)
        done += 1
        with open(last, "w") as file:
            file.write(str(seed))
        seed += 1
    print(f"{done} cases up to seed {seed - 1}, {finds} finds")
    return 1 if finds else 0
