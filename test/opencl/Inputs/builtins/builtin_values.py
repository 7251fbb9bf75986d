#!/usr/bin/python3
"""Runs every overload of the built-in functions of OpenCL C, and compares its results with the standard's.

usage: builtin_values.py BUILD_FOLDER [--share N] [--only PATTERN] [--jobs N] [--options TEXT] [--folded SEED]

The overloads are those that clang's header declares for OpenCL C 3.0 and 1.2. Of each, hundreds of values are computed:
special ones, and random ones of fixed seeds. The references are in values/, by family. --folded adds calls with constants
and known ranges whose results are used (values/folded.py). Exit codes: 0 all agree, 1 some do not, or a function has no
reference; 77 skipped.
"""

import argparse
import collections
import multiprocessing
import os
import random
import re
import subprocess
import sys
import tempfile

try:
    import numpy  # pylint: disable=unused-import
    import pyopencl  # pylint: disable=unused-import
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

from declarations import declarations
from values import (atomics, bits, conversions, copies, floats, geometric, groups, images, integers, mathematics, memory,
                    relations)
from values.device import Device
from values.folded import fold
from values.formats import Vector
from values.units import Overload

HERE = os.path.dirname(os.path.abspath(__file__))
FAMILIES = (integers, bits, relations, conversions, memory, floats, geometric, mathematics, atomics, groups, copies,
            images)
# Declarations that another test has: the pattern of them, the word that stands in the test, a file of test/opencl.
ELSEWHERE = (
    (r".*image1d_array_t", "image1d_array_t", "ImageTypes_test.cpp"),
    (r".* get_fence\(", "get_fence", "OpenClC3_test.cpp"),
    (r".* wait_group_events\(", "wait_group_events", "Inputs/builtins/values/copies.py"),
)
# A kernel is compiled by a process of its own, so few kernels are fast; a very large one is slow.
UNITS_OF_KERNEL = 40
IMAGES_OF_KERNEL = 8
SHOWN = 3


def declared(build, version):
    """What clang's header declares for a version of OpenCL C and for our device."""
    features = subprocess.run([sys.executable, f"{HERE}/feature_flags.py", f"{HERE}/../../../../libdevice/opencl/Features.cmake"],
                              check=True, capture_output=True, text=True).stdout.split()
    if version == "CL1.2":
        features = [f for f in features if "__opencl_c" not in f] + ["-Xclang", "-cl-ext=-all,+cl_khr_fp16,+cl_khr_fp64"]
    with tempfile.NamedTemporaryFile(suffix=".i") as header:
        subprocess.run([f"{build}/bin/vorion-clang", "-E", "-P", "-x", "cl", f"-cl-std={version}", *features,
                        f"{build}/pocl/share/pocl/include/opencl-c.h", "-o", header.name], check=True)
        found = declarations(header.name)
    return [Overload(name, *each) for name, overloads in found.items() for each in overloads]


def overloads(build):
    """(option, overload) of all: what 1.2 declares otherwise comes after what 3.0 does."""
    found = {str(o): ("CL3.0", o) for o in declared(build, "CL3.0")}
    for overload in declared(build, "CL1.2"):
        found.setdefault(str(overload), ("CL1.2", overload))
    return list(found.values())


def made(overload, families=FAMILIES):
    """A unit of the first family that knows the function, or None."""
    return next((u for u in (family.unit(overload) for family in families) if u), None)


def tested_elsewhere(declaration):
    """Whether another test has the function."""
    for pattern, word, file in ELSEWHERE:
        if re.match(pattern, declaration):
            with open(f"{HERE}/../../{file}", encoding="utf-8") as text:
                return word in text.read()
    return False


_devices = {}


def run(task):
    """(overload, lines) of each of some; None instead of lines where there is no reference."""
    version, build_options, seed, overloads_of = task
    if version not in _devices:
        _devices[version] = Device([f"-cl-std={version}", *build_options])
    units = [(o, made(o)) for o in overloads_of]
    results = [(str(o), None) for o, unit in units if not unit]
    alike = collections.defaultdict(list)
    for _, unit in units:
        if unit:
            if seed is not None:
                fold(unit, seed)
            alike[unit.items, unit.group, bool(unit.images)].append(unit)
    for (_, _, images_of), group in alike.items():
        # A kernel has few images.
        most = IMAGES_OF_KERNEL if images_of else len(group)
        for first in range(0, len(group), most):
            part = group[first:first + most]
            results += zip((str(u.overload) for u in part), _devices[version].run(part))
    return results


def width_of(overload):
    return max((Vector(n).width for n, _ in overload.kinds() if Vector.known(n)), default=1)


def is_conversion(overload):
    """Conversions are compiled apart: their inputs are their own."""
    return overload.name.startswith("convert_")


def share_of(found, forms):
    """Of each function one form, or a scalar form and a vector."""
    source = random.Random(1)
    by_name = collections.defaultdict(list)
    for each in found:
        by_name[each[1].name, forms == 2 and width_of(each[1]) > 1].append(each)
    chosen = {id(source.choice(group)) for group in by_name.values()}
    return [each for each in found if id(each) in chosen]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build")
    parser.add_argument("--share", type=int, choices=(1, 2), help="so many forms of each function: one, or a scalar and a vector")
    parser.add_argument("--only", default="", help="functions whose names match")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--options", default="", help="more options of the kernels' builds")
    parser.add_argument("--folded", type=int, metavar="SEED", help="also calls with constants and known ranges")
    options = parser.parse_args()

    build = os.path.abspath(options.build)
    # For this process and those that it starts.
    os.environ["VORION_ROOT"] = build
    os.environ.setdefault("OCL_ICD_VENDORS", f"{build}/etc/OpenCL/vendors")
    found = [each for each in overloads(build) if re.search(options.only, each[1].name)]
    if not found:
        parser.error(f"no function's name matches {options.only}")
    if options.share:
        found = share_of(found, options.share)
    groups, missing = collections.defaultdict(list), []
    for version, overload in found:
        groups[version, width_of(overload), is_conversion(overload)].append(overload)
    tasks = [(key[0], options.options.split(), options.folded, units[n:n + UNITS_OF_KERNEL]) for key, units in groups.items()
             for n in range(0, len(units), UNITS_OF_KERNEL)]
    wrong = collections.Counter()
    count = elsewhere = 0
    with multiprocessing.get_context("spawn").Pool(options.jobs) as pool:
        for results in pool.imap_unordered(run, tasks):
            for title, lines in results:
                name = re.search(r"(\w+)\(", title)[1]
                if lines is None and tested_elsewhere(title):
                    elsewhere += 1
                    continue
                if lines is None:
                    missing.append(title)
                    continue
                count += 1
                if lines:
                    wrong[name] += 1
                    print(f"WRONG {title}: {len(lines)} of its results", *lines[:SHOWN], sep="\n  ", flush=True)
    for title in sorted(missing):
        print(f"no reference: {title}")
    print(f"{count} overloads ran, {elsewhere} are tested elsewhere, {sum(wrong.values())} are wrong"
          + (f": {', '.join(sorted(wrong))}" if wrong else ""))
    return 1 if wrong or missing else 0


if __name__ == "__main__":
    sys.exit(main())
