#!/usr/bin/env python3
"""Says where the host's processor time of an OpenCL program goes, by kernel and engine.

usage: host_time.py [--rounds 5] [--iterations FEW MANY] [--engines interpreter,auto] [--json FILE] -- PROGRAM OPTIONS ...

The rounds are interleaved, figures are medians. "outside kernels" is what the whole process takes without its kernels: files,
compiling, copies, the host's part of the work. With --iterations the program runs with `--iterations FEW` and with
`--iterations MANY`, and the figures are of one iteration between these. {folder} in an option is a new, empty folder.
VORION_STATS gives the kernels' times. It writes its file after each kernel, so the whole process is measured in runs without
it. "outside kernels" is "-" if the runs lie further apart than that figure. Exit codes: 0, 1 a run failed, 2 usage.
"""
import argparse
import collections
import json
import os
import statistics
import subprocess
import sys
import tempfile

import command_line

LEAST_SHARE = 0.01


def run(command, engine, stats=None):
    """The processor seconds of the process and its children, and of its kernels by name if `stats` names a file for them."""
    environment = {**os.environ, "VORION_SET": f"engine={engine}"}
    if stats:
        environment["VORION_STATS"] = stats
    with tempfile.TemporaryDirectory() as folder:
        process = subprocess.Popen([option.replace("{folder}", folder) for option in command], env=environment,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        errors = process.stderr.read()
        _, status, used = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode:
        sys.exit(f"host_time.py: error: {command[0]} ended with {process.returncode}: {errors.strip()[-400:]}")
    kernels = collections.Counter()
    if stats:
        with open(stats, encoding="utf-8") as file:
            for launch in json.load(file)["runs"]:
                kernels[launch["name"]] += launch["host_cpu_seconds"]
    return used.ru_utime + used.ru_stime, kernels


def measure(command, engine, stats):
    """The seconds of one run by kernel, of the whole process under None."""
    seconds, _ = run(command, engine)
    _, parts = run(command, engine, stats)
    parts[None] = seconds
    return parts


def once(options, command, engine, stats):
    """What measure() gives, or the same of one iteration."""
    if not options.iterations:
        return measure(command, engine, stats)
    few, many = options.iterations
    less, more = [measure([*command, "--iterations", str(count)], engine, stats) for count in (few, many)]
    return {part: (more[part] - less[part]) / (many - few) for part in more}


def rows(medians, spreads):
    """(what, milliseconds by engine): kernels, the dearest first, those below LEAST_SHARE together, and what is no kernel.

    That is a difference of two runs, and None where runs lie further apart (`spreads`, by engine).
    """
    wholes = {engine: of[None] for engine, of in medians.items()}
    names = sorted({name for of in medians.values() for name in of if name},
                   key=lambda name: -max(of[name] for of in medians.values()))

    def row(what, names):
        return what, {engine: 1000 * sum(of[name] for name in names) for engine, of in medians.items()}
    large = [name for name in names if any(of[name] >= LEAST_SHARE * wholes[engine] for engine, of in medians.items())]
    found = [row(name, [name]) for name in large]
    found.append(row("other kernels", [name for name in names if name not in large]))
    kernels = row("", names)[1]
    outside = {engine: 1000 * wholes[engine] - kernels[engine] for engine in medians}
    found.append(("outside kernels", {engine: ms if abs(ms) > spreads[engine] else None for engine, ms in outside.items()}))
    found.append(row("all", [None]))
    return found


def spread(seconds):
    """How far runs lie apart, in milliseconds."""
    return 1000 * (max(seconds) - min(seconds))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rounds", type=int, default=5, help="at least 2: how far they lie apart says what is noise")
    parser.add_argument("--iterations", type=int, nargs=2, metavar=("FEW", "MANY"), help="of one iteration between these")
    parser.add_argument("--engines", default="interpreter,auto")
    parser.add_argument("--json", help="write the figures")
    options, command = command_line.parse(parser)
    command_line.check_program(parser, command)
    if options.rounds < 2:
        parser.error(f"--rounds: {options.rounds}, expected at least 2")
    if options.iterations and options.iterations[0] >= options.iterations[1]:
        parser.error("--iterations: the second number must be larger")
    engines = options.engines.split(",")
    found = {engine: [] for engine in engines}
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(options.rounds):
            for engine in engines:
                found[engine].append(once(options, command, engine, os.path.join(folder, "stats.json")))
    medians = {engine: collections.Counter({part: statistics.median(each[part] for each in runs) for part in runs[0]})
               for engine, runs in found.items()}
    spreads = {engine: spread([each[None] for each in runs]) for engine, runs in found.items()}
    table = rows(medians, spreads)
    print(f"| ms of processor time | {' | '.join(engines)} |\n|---|{'--:|' * len(engines)}")
    for what, by_engine in table:
        print(f"| {what} | {' | '.join('-' if by_engine[engine] is None else f'{by_engine[engine]:.1f}' for engine in engines)} |")
    for engine in engines:
        print(f"{engine}: all of them differ by {spreads[engine]:.1f} ms in {options.rounds} rounds")
    if options.json:
        with open(options.json, "w", encoding="utf-8") as file:
            json.dump([{"what": what, "ms": by_engine} for what, by_engine in table], file, indent=2)
    return 0


if __name__ == "__main__":
    command_line.run(main)
