"""piglit's tests of OpenCL, as Debian's package installs them."""

import glob
import os
import re
import subprocess

from suite import Problem, Test

ENDINGS = {"pass": "passed", "warn": "passed", "skip": "skipped", "fail": "failed", "crash": "crashed"}


def tests(folder):
    """Calls of the API, each a program, and kernels with the results that they should give."""
    folder = folder or installed()
    runner = os.path.join(folder, "bin", "cl-program-tester")
    programs = sorted(glob.glob(os.path.join(folder, "bin", "cl-api-*")) +
                      glob.glob(os.path.join(folder, "bin", "cl-custom-*")))
    kernels = sorted(path for part in ("tests", "generated_tests") for ending in ("cl", "program_test")
                     for path in glob.glob(os.path.join(folder, part, "cl", "**", "*." + ending), recursive=True)
                     if not os.path.basename(path).startswith("template"))
    if not os.path.exists(runner) or not kernels:
        raise Problem(f"{folder}: no bin/cl-program-tester with tests, expected an installed piglit")
    found = [Test("piglit-api", os.path.basename(path).removeprefix("cl-"), (path,), (path,), outcome)
             for path in programs]
    for path in kernels:
        name = os.path.splitext(os.path.relpath(path, folder))[0].replace(os.sep, ".")
        found.append(Test("piglit-program", name, (runner, path), (runner, path), outcome))
    return found


def installed():
    try:
        listed = subprocess.run(["dpkg", "-L", "piglit"], capture_output=True, text=True, check=True).stdout
    except (OSError, subprocess.CalledProcessError):
        raise Problem("piglit is not installed, expected the package or its folder") from None
    return next(line.removesuffix("/bin/cl-program-tester") for line in listed.splitlines()
                if line.endswith("/bin/cl-program-tester"))


def outcome(text, code):
    """(outcome, reason) by the last result that a program reports, and the first line that says what failed."""
    found = re.findall(r'^PIGLIT: \{"result": "(\w+)"', text, re.M)
    if not found:
        return "failed", f"no result, exit code {code}"
    ending = ENDINGS.get(found[-1], "failed")
    why = re.search(r"^.*([Ff]ail|[Ee]rror|[Ee]xpect|not support|[Ss]kipp).*$", text, re.M)
    return ending, why.group(0).strip() if why and ending != "passed" else ""
