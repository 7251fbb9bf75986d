"""PoCL's own tests, as CMake's target pocl_tests builds them (runtime/pocl/CMakeLists.txt)."""

import json
import os
import re
import subprocess

from suite import Problem, Test

LABEL = "vorion"


def tests(folder):
    """Those that PoCL's patched build files label for the device. CTest knows their commands and what they should
    write; it does not run them, because its own settings name the platform of the folder, which is not built there."""
    folder = folder or os.path.join(os.environ.get("VORION_ROOT", ""), "pocl-tests")
    try:
        listed = subprocess.run(["ctest", "--test-dir", folder, "-L", LABEL, "--show-only=json-v1"], capture_output=True,
                                text=True, check=True).stdout
        found = [test for test in json.loads(listed)["tests"] if "command" in test]
    except (OSError, subprocess.CalledProcessError, json.JSONDecodeError, KeyError):
        found = []
    if not found:
        raise Problem(f"{folder}: no tests of PoCL, expected what `cmake --build build/dev --target pocl_tests` made")
    return [make(test) for test in found]


def make(test):
    properties = {p["name"]: p["value"] for p in test["properties"]}
    command = ("/usr/bin/env", "-C", properties["WORKING_DIRECTORY"], *properties.get("ENVIRONMENT", ()), *test["command"])
    program, _, name = test["name"].rpartition("/")
    return Test("pocl-" + (program or "other"), name, command, programs(test["command"]),
                lambda text, code: outcome(properties, text, code))


def programs(command):
    """The test's program. Where CMake compares what it writes, it is given as test_cmd, with its arguments behind ####."""
    for word in command:
        path = word.removeprefix("-Dtest_cmd=").split("####")[0]
        if path != word and os.path.isfile(path):
            return (path,)
    return tuple(word for word in command[:1] if os.path.isfile(word))


def outcome(properties, text, code):
    """(outcome, reason) as CTest decides."""
    def matches(name): # CMake's dot is any character
        return any(re.search(pattern, text, re.DOTALL) for pattern in properties.get(name, ()))

    lines = [line.strip() for line in text.splitlines() if line.strip()]
    why = next((line for line in lines if line.startswith("FAIL")), lines[-1] if lines else f"exit code {code}")
    if code == properties.get("SKIP_RETURN_CODE") or matches("SKIP_REGULAR_EXPRESSION"):
        return "skipped", why
    if matches("FAIL_REGULAR_EXPRESSION"):
        return "failed", why
    good = matches("PASS_REGULAR_EXPRESSION") if "PASS_REGULAR_EXPRESSION" in properties else code == 0
    return ("passed", "") if good else ("failed", why)
