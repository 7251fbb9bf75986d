#!/usr/bin/env python3
"""The hand-written files that know a name, such as that of a counter, a unit, a scene format or a checker.

usage: bench/carriers.py [--json FILE] [--tree FOLDER] NAME...

Searches every file that is kept under version control for NAME as it is written in records, in C, in C++ and in Python:
`tail_blends` also finds `TailBlends`, `tailBlends` and `VR_N_TAIL_BLENDS`. Generated files are not kept, and so not
counted. Prints the files by kind, with the number of lines. It measures what a change to such a fact costs: a fact
that is one record has few carriers. Exit codes: 0, 1 a name is found nowhere, 2 usage.
"""

import argparse
import json
import os
import re
import subprocess
import sys

import command_line

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
KINDS = ("records", "production", "tests", "documents", "benchmarks")


def kind(path):
    """Of a file, by its place and name."""
    name = os.path.basename(path)
    if path.endswith(".md"):
        return "documents"
    if path.startswith("intrinsics/") and path.endswith(".td"):
        return "records"
    if path.startswith("bench/"):
        return "benchmarks"
    if path.startswith("test/") or "_test." in name or "/testing/" in path or "/fuzz/" in path:
        return "tests"
    return "production"


def pattern(name):
    """Of a name in all its spellings: words with or without underscores between them, in any case."""
    words = re.findall(r"[A-Z]?[a-z0-9]+|[A-Z0-9]+", name)
    return re.compile("[-_]?".join(re.escape(word) for word in words), re.IGNORECASE)


def carriers(tree, name):
    """{kind: {file: lines}} of the files that know a name."""
    files = subprocess.run(["git", "ls-files"], cwd=tree, check=True, capture_output=True, text=True).stdout.split("\n")
    wanted, found = pattern(name), {k: {} for k in KINDS}
    for file in filter(None, files):
        if file == "bench/carriers.py":
            continue
        try:
            with open(os.path.join(tree, file), encoding="utf-8") as f:
                lines = sum(1 for line in f if wanted.search(line))
        except (UnicodeDecodeError, FileNotFoundError, IsADirectoryError):
            continue
        if lines:
            found[kind(file)][file] = lines
    return found


def show(name, found):
    print(f"{name}: " + ", ".join(f"{len(found[k])} {k}" for k in KINDS))
    for k in KINDS:
        for file, lines in found[k].items():
            print(f"  {k:<11} {lines:>4} {file}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("names", nargs="+", metavar="NAME")
    parser.add_argument("--tree", default=ROOT, help="another checkout")
    parser.add_argument("--json", metavar="FILE")
    args = parser.parse_args()
    found = {name: carriers(args.tree, name) for name in args.names}
    for name, files in found.items():
        show(name, files)
    if args.json:
        with open(args.json, "w", encoding="utf-8") as f:
            json.dump(found, f, indent=2)
    sys.exit(0 if all(any(files.values()) for files in found.values()) else 1)


if __name__ == "__main__":
    command_line.run(main)
