#!/usr/bin/env python3
"""Checks the places that a page docs/adding-*.md lists but nobody can follow in a test.

usage: places.py PAGE
The page has a table whose rows are a step's number, a file and what stands there. The first word in backquotes of the
last column must stand in the file.
Exit codes: 0 every place is as the page says, 1 not, 2 usage.
"""

import argparse
import os
import re
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
ROW = re.compile(r"^\| \d+ \| `([^`]+)` \| [^`|]*`([^`]+)`", re.M)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("page")
    page = parser.parse_args().page
    with open(os.path.join(ROOT, page), encoding="utf-8") as opened:
        text = opened.read()
    rows = ROW.findall(text)
    if len(rows) != len(re.findall(r"^\| \d+ \|", text, re.M)):
        sys.exit(f"places.py: error: {page}: a row without a file or without a word in backquotes, expected both")
    for file, word in rows:
        path = os.path.join(ROOT, file)
        if not os.path.exists(path):
            sys.exit(f"places.py: error: {page}: no file {file}, expected the place of a step")
        with open(path, encoding="utf-8") as opened:
            if word not in opened.read():
                sys.exit(f"places.py: error: {page}: {file} does not have '{word}', expected what the page says")
    print(f"{len(rows)} places")


if __name__ == "__main__":
    main()
