#!/usr/bin/env python3
"""Follows every link of the Markdown below a folder: each leads to a file or a folder that is there, and to a heading
that the page has.

usage: markdown_links.py FOLDER
Prints an error for each fault, then the number of pages. Exit codes: 0 no fault, 1 faults, 2 usage.
"""

import os
import re
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "Inputs"))
from followed import report, target_of

FENCE = re.compile(r"^( *)```.*?^ *```$", re.M | re.S)
CODE = re.compile(r"(`+)(?!`).*?(?<!`)\1(?!`)", re.S)
LINK = re.compile(r"\]\(\s*([^()\s]+)\s*\)")
HEADING = re.compile(r"^#+ +(.*?) *$", re.M)


def headings(text):
    """The anchors of a page, as GitHub makes them of its headings."""
    made = []
    for heading in HEADING.findall(FENCE.sub("", text)):
        heading = re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", heading)
        anchor = re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")
        made.append(anchor if anchor not in made else f"{anchor}-{made.count(anchor)}")
    return set(made) | set(re.findall(r'<a (?:id|name)="([^"]+)"', text))


def main():
    if len(sys.argv) != 2:
        print(__doc__, file=sys.stderr)
        return 2
    pages = {}
    for folder, _, names in os.walk(sys.argv[1]):
        for path in (os.path.join(folder, name) for name in names if name.endswith(".md")):
            with open(path, encoding="utf-8") as f:
                pages[os.path.normpath(path)] = f.read()
    faults, links = [], 0
    for path, text in sorted(pages.items()):
        # Code has brackets of its own; a link's text may be code.
        for link in LINK.findall(CODE.sub("code", FENCE.sub("", text))):
            found = target_of(path, link)
            if not found:
                continue
            links += 1
            target, heading = found
            name = os.path.relpath(path, sys.argv[1])
            if not os.path.exists(target):
                faults.append(f"{name} links to {link}, which is missing")
            elif heading and target in pages and heading not in headings(pages[target]):
                faults.append(f"{name} links to {link}, but the page has no such heading")
    return report("markdown_links.py", faults, len(pages), links)


if __name__ == "__main__":
    sys.exit(main())
