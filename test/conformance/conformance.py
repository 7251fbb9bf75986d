#!/usr/bin/env python3
"""Runs the test programs of OpenCL's conformance suite that are built in a folder, PoCL's own tests, or those that
Debian packages have, and prints one table.

usage: scripts/conformance.sh FOLDER [--only PATTERN] [--limit SECONDS] [--results FILE] [--json FILE]
       scripts/conformance.sh --pocl [FOLDER] [the same options]
       scripts/conformance.sh --packages [FOLDER] [the same options]

FOLDER is where the suite was built, or any folder above its programs, which are named test_*. Every subtest runs as a
process of its own, in the suite's wimpy mode. With --pocl it is what CMake's target pocl_tests built, if not the build
folder's pocl-tests. With --packages it is where piglit is installed, if not where its package says. A result is kept in the results file with the hash of what made it: the test and the platform. So a run
that was ended goes on where it was, and a new build is measured anew.

exit codes: 0 every subtest passed or was skipped by the suite, 1 some did not, 2 usage, 3 a file or folder
"""

import argparse
import collections
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


def options():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", nargs="?")
    suites = parser.add_mutually_exclusive_group()
    suites.add_argument("--pocl", action="store_true", help="PoCL's own tests")
    suites.add_argument("--packages", action="store_true", help="what packages have: piglit's tests of OpenCL")
    parser.add_argument("--only", default="", metavar="PATTERN", help="a regular expression on PROGRAM/SUBTEST")
    parser.add_argument("--limit", type=float, default=600, metavar="SECONDS", help="for one subtest (default: 600)")
    parser.add_argument("--results", default=None, metavar="FILE", help="default: conformance.jsonl in FOLDER, piglit.jsonl or pocl.jsonl here")
    parser.add_argument("--json", metavar="FILE", help="all results as JSON")
    args = parser.parse_args()
    if not args.folder and not args.packages and not args.pocl:
        parser.error("no FOLDER, expected one with the suite's programs, --pocl or --packages")
    return args


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
    patterns = ("pocl/lib/libpocl.so", "pocl/share/pocl/*.bc", "bin/vorion-clang", "bin/vorion-link", "lib/libvorion-runtime.so",
                "lib/vorion/*")
    return sorted(path for pattern in patterns for path in glob.glob(os.path.join(root, pattern))
                  if os.path.isfile(path))


def end_session(leader):
    """Ends all processes of a session. Its process group is not enough: CMake gives what it runs groups of their own."""
    for stat in glob.glob("/proc/[0-9]*/stat"):
        try:
            with open(stat, encoding="utf-8", errors="replace") as file:
                session = file.read().rpartition(")")[2].split()[3] # behind the name: state, parent, group, session
            if int(session) == leader:
                os.kill(int(stat.split("/")[2]), signal.SIGKILL)
        except (FileNotFoundError, ProcessLookupError):
            pass


def run(test, limit):
    begun = time.monotonic()
    process = subprocess.Popen(test.command, cwd=os.path.dirname(test.command[0]), stdout=subprocess.PIPE,
                               stderr=subprocess.STDOUT, start_new_session=True)
    try:
        text, _ = process.communicate(timeout=limit)
        found, reason = test.judge(text.decode(errors="replace"), process.returncode)
        if process.returncode < 0:
            found, reason = "crashed", signal.Signals(-process.returncode).name
    except subprocess.TimeoutExpired:
        end_session(process.pid)
        process.communicate()
        found, reason = "time", f"more than {limit:g} s"
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


def measure(args):
    """All chosen results, in the order of programs and subtests."""
    suite = piglit if args.packages else pocl if args.pocl else cts
    tests = [test for test in suite.tests(args.folder) if re.search(args.only, f"{test.program}/{test.name}")]
    if not tests:
        raise Problem(f"--only {args.only}: no subtest matches, expected a part of PROGRAM/SUBTEST")
    platform = digest(platform_files())
    path = args.results or (os.path.join(args.folder, "conformance.jsonl") if suite is cts else suite.__name__ + ".jsonl")
    kept = kept_results(path)
    results = []
    hashes = {}
    with open(path, "a", encoding="utf-8") as file:
        for test in tests:
            if test.files not in hashes:
                hashes[test.files] = platform + "-" + digest(test.files)
            made_by = hashes[test.files]
            result = kept.get((test.program, test.name))
            if not result or result["made_by"] != made_by:
                result = {"program": test.program, "test": test.name, "made_by": made_by, **run(test, args.limit)}
                file.write(json.dumps(result) + "\n")
                file.flush()
                print(f"{test.program}/{test.name}: {result['outcome']}, {result['seconds']:g} s", file=sys.stderr,
                      flush=True)
            results.append(result)
    return results


def print_tables(results):
    counts = collections.defaultdict(collections.Counter)
    for result in results:
        counts[result["program"]][result["outcome"]] += 1
    counts["all"] = sum(list(counts.values()), collections.Counter())
    print("| program | subtests | " + " | ".join(OUTCOMES) + " |\n|---|--:" + "|--:" * len(OUTCOMES) + "|")
    for program, found in counts.items():
        print(f"| {program} | {sum(found.values())} | " + " | ".join(str(found[o]) for o in OUTCOMES) + " |")
    open_ones = [r for r in results if r["outcome"] not in ("passed", "skipped")]
    if open_ones:
        print("\n| subtest | outcome | reason |\n|---|---|---|")
        for r in open_ones:
            print(f"| {r['program']}/{r['test']} | {r['outcome']} | {r['reason'].replace('|', '/')} |")
    print(f"\n{len(results)} subtests, {sum(r['seconds'] for r in results):.0f} s")
    return not open_ones


def main():
    args = options()
    try:
        results = measure(args)
        if args.json:
            with open(args.json, "w", encoding="utf-8") as file:
                json.dump(results, file, indent=1)
    except (Problem, OSError, json.JSONDecodeError) as problem:
        print(f"conformance.sh: error: {problem}", file=sys.stderr)
        return 3
    return 0 if print_tables(results) else 1


if __name__ == "__main__":
    sys.exit(main())
