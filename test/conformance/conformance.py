#!/usr/bin/env python3
"""Runs the test programs of OpenCL's conformance suite that are built in a folder, and prints one table.

usage: scripts/conformance.sh FOLDER [--only PATTERN] [--limit SECONDS] [--results FILE] [--json FILE]

FOLDER is where the suite was built, or any folder above its programs, which are named test_*. Every subtest runs as a
process of its own, in the suite's wimpy mode. A result is kept in the results file with the hash of what made it: the
test program and the platform. So a run that was ended goes on where it was, and a new build is measured anew.

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

# In the order of the table. "time": it ran into the limit.
OUTCOMES = ("passed", "skipped", "failed", "crashed", "time")


class Problem(Exception):
    pass


def options():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder")
    parser.add_argument("--only", default="", metavar="PATTERN", help="a regular expression on PROGRAM/SUBTEST")
    parser.add_argument("--limit", type=float, default=600, metavar="SECONDS", help="for one subtest (default: 600)")
    parser.add_argument("--results", default=None, metavar="FILE", help="default: conformance.jsonl in FOLDER")
    parser.add_argument("--json", metavar="FILE", help="all results as JSON")
    return parser.parse_args()


def programs(folder):
    if not os.path.isdir(folder):
        raise Problem(f"{folder}: no such folder, expected one with programs of the suite")
    found = [os.path.join(base, name) for base, _, names in os.walk(folder) for name in names
             if name.startswith("test_") and os.access(os.path.join(base, name), os.X_OK)]
    if not found:
        raise Problem(f"{folder}: no programs named test_*, expected the suite's")
    return sorted(found)


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


def subtests(program):
    done = subprocess.run([program, "--list"], capture_output=True, text=True, errors="replace", timeout=60)
    return [line.strip() for line in done.stdout.splitlines() if re.fullmatch(r"\t\w+", line)]


def outcome(text, code, name):
    """(outcome, reason) by what the suite prints of a subtest."""
    def first(pattern):
        match = re.search(pattern, text, re.M)
        return match.group(0).strip() if match else ""
    if code < 0:
        return "crashed", signal.Signals(-code).name
    if re.search(rf"^{name} (skipped|test not supported)", text, re.M):
        return "skipped", first(rf"^{name} skipped.*$") or first(r"^.*(not support|[Ss]kipp|requires).*$")
    if code == 0 and re.search(rf"^{name} passed", text, re.M):
        return "passed", ""
    return "failed", first(r"^\s*ERROR.*$") or f"exit code {code}"


def run(program, name, limit):
    begun = time.monotonic()
    process = subprocess.Popen([program, "-w", name], cwd=os.path.dirname(program), stdout=subprocess.PIPE,
                               stderr=subprocess.STDOUT, start_new_session=True)
    try:
        text, _ = process.communicate(timeout=limit)
        found, reason = outcome(text.decode(errors="replace"), process.returncode, name)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
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
    found = programs(args.folder)
    platform = digest(platform_files())
    path = args.results or os.path.join(args.folder, "conformance.jsonl")
    kept = kept_results(path)
    results = []
    with open(path, "a", encoding="utf-8") as file:
        for program in found:
            short = os.path.basename(program).removeprefix("test_")
            made_by = platform + "-" + digest([program])
            for name in subtests(program):
                if not re.search(args.only, f"{short}/{name}"):
                    continue
                result = kept.get((short, name))
                if not result or result["made_by"] != made_by:
                    result = {"program": short, "test": name, "made_by": made_by, **run(program, name, args.limit)}
                    file.write(json.dumps(result) + "\n")
                    file.flush()
                    print(f"{short}/{name}: {result['outcome']}, {result['seconds']:g} s", file=sys.stderr, flush=True)
                results.append(result)
    if not results:
        raise Problem(f"--only {args.only}: no subtest matches, expected a part of PROGRAM/SUBTEST")
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
