"""The subtests of OpenCL-CTS, the conformance suite of the Khronos Group."""

import functools
import os
import re
import subprocess

from suite import Problem, Test


def tests(folder):
    """All subtests of the programs below a folder, in wimpy mode."""
    return [Test(os.path.basename(program).removeprefix("test_"), name, (program, "-w", name), (program,),
                 functools.partial(outcome, name))
            for program in programs(folder) for name in subtests(program)]


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
    return [line.strip() for line in done.stdout.splitlines() if re.fullmatch(r"\t\w+", line)]


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
