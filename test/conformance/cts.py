"""The subtests of OpenCL-CTS, the conformance suite of the Khronos Group."""

import functools
import itertools
import os
import re
import subprocess

from suite import Problem, Test

# Seconds for a subtest, where it has thousands of kernels.
LIMITS = {"c11_atomics": 3600, "vectors": 1800}

# How many times fewer values than all.
FACTOR = "-[8192]"

INTEGERS = [sign + width for width in ("char", "short", "int", "long") for sign in ("", "u")]
FLOATS = ["half", "float", "double"]
ROUNDINGS = ["", "_rte", "_rtp", "_rtn", "_rtz"]

FILTERED = ["CL_UNORM_INT8", "CL_UNORM_INT16", "CL_SNORM_INT8", "CL_SNORM_INT16", "CL_HALF_FLOAT", "CL_FLOAT"]
CHANNEL_TYPES = FILTERED + [f"CL_{sign}SIGNED_INT{bits}" for bits in (8, 16, 32) for sign in ("", "UN")]


def tests(folder):
    """All runs of the subtests of the programs below a folder, in wimpy mode."""
    found = []
    for path in programs(folder):
        program = os.path.basename(path).removeprefix("test_")
        found += [Test(program, " ".join(words), (path, "-w", *words), (path,), functools.partial(outcome, name),
                       LIMITS.get(program, 600))
                  for name in subtests(path) for words in runs(program, name)]
    return found


def runs(program, name):
    """What to tell a program beside -w for each run of a subtest. A subtest that would take hours has several."""
    if program == "conversions":
        return [(kind, FACTOR) for kind in conversions()]
    if program == "bruteforce":
        return [(name, FACTOR)]
    if program == "c11_atomics":
        return [(name, "-internalIterations", "100")] # of 10,000
    if program == "image_streams" and re.fullmatch(r"[123]D(array)?", name):
        return ([(name, type, "CL_FILTER_NEAREST") for type in CHANNEL_TYPES] +
                [(name, type, "CL_FILTER_LINEAR") for type in FILTERED])
    return [(name,)]


def conversions():
    """The names of all functions convert_TO of one argument, as the suite writes them."""
    for to, source, rounding in itertools.product(INTEGERS + FLOATS, INTEGERS + FLOATS, ROUNDINGS):
        for saturation in ("", "_sat") if to in INTEGERS else ("",):
            yield f"{to}{saturation}{rounding}_{source}"


def programs(folder):
    if not os.path.isdir(folder):
        raise Problem(f"{folder}: no such folder, expected one with programs of the suite")
    found = [os.path.join(base, name) for base, _, names in os.walk(folder) for name in names
             if name.startswith("test_") and os.access(os.path.join(base, name), os.X_OK)]
    if not found:
        raise Problem(f"{folder}: no programs named test_*, expected the suite's")
    return sorted(found)


def subtests(program):
    done = subprocess.run([program, "--list"], capture_output=True, text=True, errors="replace", timeout=60)
    found = [line.strip() for line in done.stdout.splitlines() if re.fullmatch(r"\t\w+", line)]
    if not found:
        raise Problem(f"{program}: --list shows no subtests, expected a program of the suite that starts here")
    return found


def outcome(name, text, code):
    """(outcome, reason) by what the suite prints of a subtest."""
    def first(pattern):
        match = re.search(pattern, text, re.M)
        return match.group(0).strip() if match else ""
    if re.search(rf"^({name} (skipped|test not supported)|Test skipped while initialization)", text, re.M):
        return "skipped", first(rf"^{name} skipped.*$") or first(r"^.*(not support|[Ss]kipp|requires).*$")
    # Some programs leave a line open before that.
    if code == 0 and re.search(rf"(^|\W){name} passed$", text, re.M):
        return "passed", ""
    return "failed", first(r"^\s*ERROR.*$") or f"exit code {code}"
