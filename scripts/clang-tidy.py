#!/usr/bin/env python3
"""Runs clang-tidy on what the build compiles of our files, and remembers which of them passed: a file is looked at
again only once it, a header that it includes, its command, the checks or clang-tidy have changed.

usage: clang-tidy.py BUILD ROOT [--all] [--seconds N]
--all: tests too; files that passed are looked at again as well
--seconds N: begins no file after N seconds, and says how many are left; the files of the last commits come first
Exit codes: 0 nothing found, 1 something was, 2 usage
"""

import argparse
import concurrent.futures
import functools
import hashlib
import json
import os
import re
import shlex
import subprocess
import sys
import time

# LLVM's and PoCL's passes follow the naming of the code they extend and are left out.
FOLDERS = ("support", "isasim", "libdevice", "runtime", "apps", "reference", "test")
CLANG_TIDY, SCAN_DEPS = "clang-tidy-19", "clang-scan-deps-19"
# It reads each file without the headers that the build compiles once: a file that does not include what it uses is
# found here.
PRECOMPILED = re.compile(r"-Xclang -include(-pch)? -Xclang \S+|-Winvalid-pch|-fpch-instantiate-templates")


def commands(build, root, with_tests):
    """The commands of our files, each file once."""
    ours = tuple(f"{root}/{folder}/" for folder in FOLDERS)
    found = {}
    with open(os.path.join(build, "compile_commands.json"), encoding="utf-8") as file:
        for entry in json.load(file):
            path = os.path.realpath(entry["file"])
            if path.startswith(ours) and path.endswith(".cpp") and (with_tests or not path.endswith("_test.cpp")):
                command = PRECOMPILED.sub("", entry["command"])
                found.setdefault(path, entry | {"command": command, "file": path})
    return found


@functools.cache
def identity(path, root):
    """The contents of a file of ours; of the system's files, size and time are enough."""
    if path.startswith(root + os.sep):
        with open(path, "rb") as file:
            return hashlib.sha256(file.read()).hexdigest()
    state = os.stat(path)
    return f"{state.st_size} {state.st_mtime_ns}"


def inputs(database, jobs):
    """What each file reads, by file, as the preprocessor finds it."""
    said = subprocess.run([SCAN_DEPS, f"-compilation-database={database}", "-format=make", "-j", str(jobs)],
                          capture_output=True, text=True, check=False)
    found = {}
    for rule in re.split(r"(?<!\\)\n", said.stdout):
        _, colon, names = rule.partition(": ")
        files = [os.path.realpath(name) for name in shlex.split(names.replace("\\\n", " "))] if colon else []
        if files:
            found[files[0]] = files
    return found


def keys(found, read, root, plugin):
    """For each file, what its result depends on; not for those that the preprocessor could not read."""
    version = subprocess.run([CLANG_TIDY, "--version"], capture_output=True, text=True, check=True).stdout
    common = [version, identity(plugin, root), identity(os.path.join(root, ".clang-tidy"), root)]
    return {path: hashlib.sha256("\n".join(
        [*common, entry["command"], *(f"{name} {identity(name, root)}" for name in sorted(set(read[path])))]).encode()
    ).hexdigest() for path, entry in found.items() if path in read}


def latest_first(paths, root):
    """The files of the last commits first, as far as the history is there."""
    said = subprocess.run(["git", "-C", root, "log", "-n", "100", "--format=", "--name-only"],
                          capture_output=True, text=True, check=False).stdout
    place = {}
    for name in said.split("\n"):
        place.setdefault(os.path.join(root, name), len(place))
    return sorted(paths, key=lambda path: (place.get(path, len(place)), path))


def load(path):
    try:
        with open(path, encoding="utf-8") as file:
            return json.load(file)
    except (OSError, ValueError):
        return {}


def save(path, value):
    with open(path + ".new", "w", encoding="utf-8") as file:
        json.dump(value, file, indent=1)
    os.replace(path + ".new", path)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build")
    parser.add_argument("root")
    parser.add_argument("--all", action="store_true")
    parser.add_argument("--seconds", type=float, default=float("inf"))
    options = parser.parse_args()
    end = time.monotonic() + options.seconds
    build, root = os.path.realpath(options.build), os.path.realpath(options.root)
    # Its checks would walk through every declaration of the system's headers, which takes three quarters of the time
    # and finds nothing that is shown.
    plugin = os.path.join(build, "lib", "libvorion-own-declarations.so")
    if not os.path.exists(plugin):
        print(f"clang-tidy.py: error: no {plugin}, expected what scripts/setup.sh builds", file=sys.stderr)
        return 1
    folder = os.path.join(build, "lint")
    os.makedirs(folder, exist_ok=True)
    database, record = os.path.join(folder, "compile_commands.json"), os.path.join(folder, "passed.json")
    found = commands(build, root, options.all)
    with open(database, "w", encoding="utf-8") as file:
        json.dump(list(found.values()), file)
    jobs = len(os.sched_getaffinity(0))
    now = keys(found, inputs(database, jobs), root, plugin)
    passed = {path: key for path, key in load(record).items() if os.path.exists(path)}
    changed = [path for path in latest_first(found, root)
               if options.all or path not in now or passed.get(path) != now[path]]
    print(f"clang-tidy: {len(changed)} of {len(found)} files are new or have changed since they passed", flush=True)

    def check(path):
        if time.monotonic() > end:
            return path, None
        command = [CLANG_TIDY, "-p", folder, "--quiet", f"--load={plugin}", path]
        return path, subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)

    failed = left = 0
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        for path, done in pool.map(check, changed):
            if done is None:
                left += 1
                continue
            if done.returncode == 0 and path in now:
                passed[path] = now[path]
                save(record, passed)  # now, since the next ones may be interrupted
            if done.returncode != 0:
                failed += 1
                print(done.stdout, end="", flush=True)
    if left:
        print(f"clang-tidy: {left} of {len(changed)} files were not looked at, because the time was over")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
