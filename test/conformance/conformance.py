#!/usr/bin/env python3
"""Runs the test programs of OpenCL's conformance suite that are built in a folder, PoCL's own tests, or those that
Debian packages have, and prints one table.

usage: scripts/conformance.sh FOLDER [--only PATTERN] [--limit SECONDS] [--results FILE] [--json FILE]
       scripts/conformance.sh --pocl [FOLDER] [the same options]
       scripts/conformance.sh --packages [FOLDER] [the same options]

FOLDER is where the suite was built, or any folder above its programs, which are named test_*. Every subtest runs as a
process of its own, in the suite's wimpy mode; long ones in several parts. With --pocl it is what CMake's target
pocl_tests built, if not the build folder's pocl-tests. With --packages it is where piglit is installed, if not where its
package says. A result is kept in the results file with the hash of what made it: the test and the platform. So a run
that was ended goes on where it was, and a new build is measured anew.

exit codes: 0 every subtest passed, was skipped by the suite, or ended as reasons.md says, 1 some did not, 2 usage, 3 a
file or folder
"""

import argparse
import collections
import concurrent.futures
import contextlib
import glob
import hashlib
import json
import os
import re
import signal
import subprocess
import sys
import time

import cts
import piglit
import pocl
from suite import OUTCOMES, Problem

# What a user or `timeout` sends to end a run.
ENDING = (signal.SIGINT, signal.SIGTERM)


def options():
    parser = argparse.ArgumentParser(prog="conformance.sh", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", nargs="?")
    suites = parser.add_mutually_exclusive_group()
    suites.add_argument("--pocl", action="store_true", help="PoCL's own tests")
    suites.add_argument("--packages", action="store_true", help="what packages have: piglit's tests of OpenCL")
    parser.add_argument("--only", default="", metavar="PATTERN", help="a regular expression on PROGRAM/SUBTEST")
    parser.add_argument("--limit", type=float, metavar="SECONDS", help="for one subtest (default: 600, of c11_atomics 3600, of vectors 1800)")
    parser.add_argument("--jobs", type=positive, default=1, metavar="N", help="subtests at a time (default: 1)")
    parser.add_argument("--results", default=None, metavar="FILE", help="default: conformance.jsonl in FOLDER, piglit.jsonl or pocl.jsonl here")
    parser.add_argument("--json", metavar="FILE", help="all results as JSON")
    parser.add_argument("--reasons", default=os.path.join(os.path.dirname(__file__), "reasons.md"), metavar="FILE",
                        help="a table of the subtests that are known not to pass (default: reasons.md beside this program)")
    args = parser.parse_args()
    if not args.folder and not args.packages and not args.pocl:
        parser.error("no FOLDER, expected one with the suite's programs, --pocl or --packages")
    return args


def positive(text):
    number = int(text)
    if number < 1:
        raise ValueError
    return number


def digest(paths):
    sum_of_all = hashlib.sha256()
    for path in paths:
        with open(path, "rb") as file:
            sum_of_all.update(file.read())
    return sum_of_all.hexdigest()[:16]


def platform_files():
    """What a result depends on besides the test: the platform, its built-in functions, the compiler and the machine."""
    root = os.environ.get("VORION_ROOT")
    if not root:
        raise Problem("VORION_ROOT is not set, expected scripts/env.sh to be sourced")
    patterns = ("pocl/lib/libvorion-pocl*.so", "pocl/share/pocl/*.bc", "bin/vorion-compiler", "bin/vorion-clang", "bin/vorion-link",
                "lib/libvorion-runtime.so", "lib/vorion/*")
    return sorted(path for pattern in patterns for path in glob.glob(os.path.join(root, pattern))
                  if os.path.isfile(path))


def alive(leader):
    """The processes of a session."""
    for stat in glob.glob("/proc/[0-9]*/stat"):
        try:
            with open(stat, encoding="utf-8", errors="replace") as file:
                state, _, _, session = file.read().rpartition(")")[2].split()[:4] # behind the name; then parent, group
        except (FileNotFoundError, ProcessLookupError):
            continue
        if int(session) == leader and state not in "ZX":
            yield int(stat.split("/")[2])


def end_session(leader):
    """Ends all processes of a session. Its process group is not enough: CMake gives what it runs groups of their own.
    Nor is it enough to look once: one that is ended may have begun another meanwhile, which would keep the pipe open."""
    while processes := list(alive(leader)):
        for process in processes:
            with contextlib.suppress(ProcessLookupError):
                os.kill(process, signal.SIGKILL)
        time.sleep(0.01)


class Running:
    """The sessions of processes that run, which end() ends, and those that are only begun then."""

    def __init__(self):
        self.leaders = set()
        self.ended = False

    def begin(self, leader):
        self.leaders.add(leader)
        if self.ended:
            end_session(leader)

    def end(self):
        self.ended = True
        for leader in tuple(self.leaders):
            end_session(leader)


def run(test, limit, running):
    begun = time.monotonic()
    process = subprocess.Popen(test.command, cwd=os.path.dirname(test.command[0]), stdout=subprocess.PIPE,
                               stderr=subprocess.STDOUT, start_new_session=True)
    running.begin(process.pid)
    try:
        text, _ = process.communicate(timeout=limit)
        found, reason = test.judge(text.decode(errors="replace"), process.returncode)
        if process.returncode < 0:
            found, reason = "crashed", signal.Signals(-process.returncode).name
    except subprocess.TimeoutExpired:
        end_session(process.pid)
        process.communicate()
        found, reason = "time", f"more than {limit:g} s"
    finally:
        running.leaders.discard(process.pid)
    return {"outcome": found, "reason": reason[:200], "seconds": round(time.monotonic() - begun, 1)}


def kept_results(path):
    """What the file has, by program and subtest. A run that was ended while it wrote leaves half a line, which is cut off."""
    kept = {}
    if os.path.exists(path):
        with open(path, "r+", encoding="utf-8") as file:
            text = file.read()
            whole = text[:text.rfind("\n") + 1]
            file.seek(0)
            file.truncate(len(whole.encode()))
        for line in whole.splitlines():
            result = json.loads(line)
            kept[result["program"], result["test"]] = result
    return kept


def known_reasons(path):
    """(outcome, reason) by program and subtest, of a table as print_tables writes it."""
    with open(path, encoding="utf-8") as file:
        rows = [[cell.strip() for cell in line.strip().strip("|").split("|")] for line in file if line.startswith("|")]
    found = {}
    for row in rows:
        if len(row) != 3:
            raise Problem(f"{path}: a row of {len(row)} cells, expected subtest, outcome and reason")
        if row[1] in OUTCOMES:
            found[row[0]] = (row[1], row[2])
    return found


def measure_all(tests, limit, jobs):
    """Each test with its result, as they end."""
    running = Running()
    pool = concurrent.futures.ThreadPoolExecutor(jobs)
    try:
        made = {pool.submit(run, test, limit or test.limit, running): test for test in tests}
        for done in concurrent.futures.as_completed(made):
            yield made[done], done.result()
    finally: # also if the user ends the run
        pool.shutdown(wait=False, cancel_futures=True)
        running.end()


def measure(args):
    """All chosen results, in the order of programs and subtests."""
    suite = piglit if args.packages else pocl if args.pocl else cts
    tests = [test for test in suite.tests(args.folder) if re.search(args.only, f"{test.program}/{test.name}")]
    if not tests:
        raise Problem(f"--only {args.only}: no subtest matches, expected a part of PROGRAM/SUBTEST")
    platform = digest(platform_files())
    path = args.results or (os.path.join(args.folder, "conformance.jsonl") if suite is cts else suite.__name__ + ".jsonl")
    results = kept_results(path)
    hashes = {files: platform + "-" + digest(files) for files in {test.files for test in tests}}
    todo = [test for test in tests
            if results.get((test.program, test.name), {}).get("made_by") != hashes[test.files]]
    with open(path, "a", encoding="utf-8") as file, contextlib.closing(measure_all(todo, args.limit, args.jobs)) as ended:
        for test, found in ended:
            result = {"program": test.program, "test": test.name, "made_by": hashes[test.files], **found}
            results[test.program, test.name] = result
            file.write(json.dumps(result) + "\n")
            file.flush()
            print(f"{test.program}/{test.name}: {result['outcome']}, {result['seconds']:g} s", file=sys.stderr, flush=True)
    return [results[test.program, test.name] for test in tests]


def rows_of_others(results, known):
    """A row for each subtest that did not pass; one for all that were skipped for the same reason."""
    skipped = collections.defaultdict(list)
    for r in results:
        if r["outcome"] == "skipped":
            skipped[r["program"], r["reason"].removeprefix(r["test"]).strip() or "not said"].append(r["test"])
    for r in results:
        name = f"{r['program']}/{r['test']}"
        if r["outcome"] not in ("passed", "skipped"):
            outcome, reason = known.get(name, ("", ""))
            yield (name, "known: " + outcome, reason) if outcome == r["outcome"] else (name, r["outcome"], r["reason"])
        elif name in known:
            yield name, r["outcome"], "known to end otherwise: " + known[name][0]
    for (program, reason), names in skipped.items():
        yield (f"{program}/{names[0]}" + (f" and {len(names) - 1} more" if names[1:] else ""), "skipped", reason)


def print_tables(results, known):
    """Whether nothing is left to explain."""
    counts = collections.defaultdict(collections.Counter)
    for result in results:
        counts[result["program"]][result["outcome"]] += 1
    counts["all"] = sum(list(counts.values()), collections.Counter())
    print("| program | subtests | " + " | ".join(OUTCOMES) + " |\n|---|--:" + "|--:" * len(OUTCOMES) + "|")
    for program, found in counts.items():
        print(f"| {program} | {sum(found.values())} | " + " | ".join(str(found[o]) for o in OUTCOMES) + " |")
    others = list(rows_of_others(results, known))
    if others:
        print("\n| subtest | outcome | reason |\n|---|---|---|")
        for name, outcome, reason in others:
            print(f"| {name} | {outcome} | {reason.replace('|', '/')} |")
    print(f"\n{len(results)} subtests, {sum(r['seconds'] for r in results):.0f} s")
    return all(outcome in OUTCOMES[:2] or outcome.startswith("known") for _, outcome, _ in others)


def end_run(number, _):
    """Ends what runs, too, on the way out. A second signal must not interrupt that, and `timeout` sends its own twice."""
    for other in ENDING:
        signal.signal(other, signal.SIG_IGN)
    sys.exit(128 + number)


def main():
    args = options()
    for number in ENDING:
        signal.signal(number, end_run)
    try:
        known = known_reasons(args.reasons)
        results = measure(args)
        if args.json:
            with open(args.json, "w", encoding="utf-8") as file:
                json.dump(results, file, indent=1)
    except (Problem, OSError, json.JSONDecodeError) as problem:
        print(f"conformance.sh: error: {problem}", file=sys.stderr)
        return 3
    return 0 if print_tables(results, known) else 1


if __name__ == "__main__":
    sys.exit(main())
