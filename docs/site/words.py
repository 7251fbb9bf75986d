#!/usr/bin/env python3
"""Counts the words of the site's pages by level.

usage: words.py [--pages] [TREE]
A word has a letter or a digit, so a table's bars are none. TREE is the repository (default: that of this file), or the
folder SITE-pages that build.py makes, which also has the pages that the tools give. The pages named in output-tables.txt are
output. --pages prints each page, too.
"""

import fnmatch
import os
import re
import sys
import tempfile

import build

WORD = re.compile(r"\S*\w\S*")
# The first pattern that fits gives the level.
LEVELS = (("start", ("README.md", "docs/README.md", "docs/start/*")), ("tasks", ("docs/tasks.md",)),
          ("tutorials", ("docs/tutorials/*",)), ("decisions", ("docs/adr/*", "docs/decisions.md")), ("changes", ("CHANGELOG.md",)),
          ("reference", ("docs/*", "CONTRIBUTING.md", "SECURITY.md")), ("folders", ("*",)))


def fits(page, patterns):
    return any(fnmatch.fnmatchcase(page, pattern) for pattern in patterns)


def counts(tree):
    """(level, page, words) of each page."""
    with open(os.path.join(os.path.dirname(os.path.abspath(__file__)), "output-tables.txt"), encoding="utf-8") as file:
        levels = [("output tables", [line for line in file.read().split("\n") if line and line[0] != "#"]), *LEVELS]
    with tempfile.TemporaryDirectory() as folder:
        build.stage(tree, folder)
        for place, _, names in os.walk(folder):
            for name in (n for n in names if n.endswith(".md")):
                path = os.path.join(place, name)
                page = os.path.relpath(path, folder)
                with open(path, encoding="utf-8") as file:
                    yield next(level for level, patterns in levels if fits(page, patterns)), page, len(WORD.findall(file.read()))


def main():
    arguments = sys.argv[1:]
    each = "--pages" in arguments
    trees = [a for a in arguments if a != "--pages"]
    if len(trees) > 1 or any(t.startswith("-") for t in trees):
        print(__doc__, file=sys.stderr)
        return 2
    found = sorted(counts(os.path.abspath(trees[0] if trees else build.ROOT)))
    if each:
        for level, page, words in found:
            print(f"{words:7} {level:14} {page}")
    for level in [name for name, _ in LEVELS] + ["output tables"]:
        pages = [words for its, _, words in found if its == level]
        print(f"{sum(pages):7} {level} ({len(pages)} pages)")
    print(f"{sum(words for level, _, words in found if level != 'output tables'):7} without output tables")
    return 0


if __name__ == "__main__":
    sys.exit(main())
