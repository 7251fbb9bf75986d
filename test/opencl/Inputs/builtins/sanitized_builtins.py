#!/usr/bin/python3
"""Runs the built-in functions of OpenCL C on the host under clang's undefined-behaviour sanitizer.

usage: sanitized_builtins.py BUILD_FOLDER FOLDER [--share N] [--only PATTERN] [--sources PATTERN] [--all] [--jobs N]

The library's sources are compiled for the host into FOLDER, what has changed since the last time. Calls, values and
references are those of builtin_values.py. Functions of images, groups, copies and atomics need the device and are left out.
Without --all, what the library's pass FreezePoison defines is not reported: overflow of integers and of conversions to
them, and shifts. Exit codes: 0 the sanitizer reports nothing and all results agree, 1 otherwise; 77 skipped.
"""

import argparse
import collections
import multiprocessing
import os
import re
import sys

from builtin_values import SHOWN, UNITS_OF_KERNEL, made, overloads, share_of
from values import (bits, conversions, floats, geometric, integers, mathematics, memory, relations)
from values.host import ALL_SANITIZERS, SANITIZERS, Host, library

FAMILIES = (integers, bits, relations, conversions, memory, floats, geometric, mathematics)

def run(task):
    """(overload, lines) of each, and the reports of the sanitizer."""
    made_library, some = task
    host = Host(*made_library)
    results = []
    alike = collections.defaultdict(list)
    for unit in (made(o, FAMILIES) for o in some):
        if unit:
            alike[unit.items, unit.group].append(unit)
    for units in alike.values():
        results += zip((str(u.overload) for u in units), host.run(units))
    return results, sorted(host.reports)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build")
    parser.add_argument("folder")
    parser.add_argument("--share", type=int, choices=(1, 2), help="so many forms of each function: one, or a scalar and a vector")
    parser.add_argument("--only", default="", help="functions whose names match")
    parser.add_argument("--sources", default="", help="files of the library whose names match")
    parser.add_argument("--all", action="store_true", help="report also what the library's pass defines")
    parser.add_argument("--jobs", type=int, default=2)
    options = parser.parse_args()

    build = os.path.abspath(options.build)
    os.environ["VORION_ROOT"] = build
    found = [(version, o) for version, o in overloads(build) if version == "CL3.0" and re.search(options.only, o.name)]
    if options.share:
        found = share_of(found, options.share)
    some = [o for _, o in found]
    made_library = library(build, os.path.abspath(options.folder), options.sources,
                           ALL_SANITIZERS if options.all else SANITIZERS)
    tasks = [(made_library, some[n:n + UNITS_OF_KERNEL]) for n in range(0, len(some), UNITS_OF_KERNEL)]
    count = wrong = 0
    reports = set()
    with multiprocessing.get_context("spawn").Pool(options.jobs) as pool:
        for results, said in pool.imap_unordered(run, tasks):
            for line in set(said) - reports:
                print(line, flush=True)
            reports.update(said)
            for title, lines in results:
                count += 1
                if lines:
                    wrong += 1
                    print(f"WRONG {title}: {len(lines)} of its results", *lines[:SHOWN], sep="\n  ", flush=True)
    print(f"{count} overloads ran, {len(reports)} places are reported, {wrong} are wrong")
    return 1 if reports or wrong else 0


if __name__ == "__main__":
    sys.exit(main())
