#!/usr/bin/env python3
"""Draws the house: which folder includes headers of which, from the includes themselves.

usage: scripts/house.py [--check] [DOCUMENT]

Writes the drawing into DOCUMENT (default: docs/tables/folders.md), between the lines `<!-- house -->` and `<!-- /house -->`.
With --check it writes nothing, and the exit code is 1 if the document shows something else. The exit code is also 1 if a
folder uses one above it and EXCEPTIONS does not say why, or if an exception is not needed any more. Tests and
fuzzers are left out: they may use everything.
"""

import argparse
import collections
import os
import re
import subprocess
import sys
import textwrap

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
BEGIN, END = "<!-- house -->\n", "<!-- /house -->\n"
# From the ground up: a folder may use those before it.
FLOORS = ("support", "intrinsics", "llvm-backend", "libdevice", "isasim", "runtime", "reference", "apps")
# (folder, what it uses above itself): why.
EXCEPTIONS = {
    ("isasim/core", "isasim/timing/trace"):
        "the timed build of the instructions writes what the clock reads, inline (adr 0007)",
    ("apps/splat/scene", "apps/splat/scene/formats"):
        "reading any scene asks each format's reader, and what they read is a scene",
}
# Where #include "..." is looked for, besides the includer's own folder.
INCLUDE_ROOTS = ("", "isasim", "isasim/include", "support/include", "runtime/include", "runtime", "llvm-backend/new",
                 "libdevice/include", "apps/splat", "reference", "runtime/pocl/new/include", "runtime/pocl/new/lib/CL/devices/vorion",
                 "runtime/pocl/new/lib/llvmopencl", "apps/samples/common")


def sources():
    """The files that take part."""
    listed = subprocess.run(["git", "ls-files"], cwd=ROOT, check=True, capture_output=True, text=True).stdout.split()
    return [f for f in listed if f.endswith((".h", ".c", ".cc", ".cpp", ".inc", ".def", ".cl")) and f.startswith(FLOORS)
            and "_test." not in f and not re.search(r"(^|/)(testing|fuzz)/|Test\.h$|TestFiles\.h$|TestDevice\.h$", f)]


def room(path):
    """The folder that a file is in; the folders of an include path are one."""
    return re.sub(r"/include(/.*)?$", "/include", os.path.dirname(path))


def generated():
    """Names of headers that the records are made into."""
    with open(os.path.join(ROOT, "intrinsics", "CMakeLists.txt"), encoding="utf-8") as f:
        return set(re.findall(r"[\w.]+\.(?:h|inc|def)\b", f.read()))


def arrows(files):
    """{room: rooms that it uses}."""
    known, made = set(files), generated()
    found = collections.defaultdict(set)
    for file in files:
        found[room(file)]
        with open(os.path.join(ROOT, file), encoding="utf-8") as f:
            names = re.findall(r'^\s*#\s*include\s+["<]([^">]+)[">]', f.read(), re.MULTILINE)
        for name in names:
            beside = os.path.normpath(os.path.join(os.path.dirname(file), name))
            rooted = (os.path.normpath(os.path.join(folder, name)) for folder in INCLUDE_ROOTS)
            if beside in known:
                target = room(beside)
            elif os.path.basename(name) in made:
                target = "intrinsics"
            else:
                target = next((room(path) for path in rooted if path in known), None)
            if target and target != room(file):
                found[room(file)].add(target)
    return found


def floor(folder):
    return FLOORS.index(folder.split("/")[0])


def reachable(arrows_of, start):
    """The rooms to which arrows lead from one, over any number of others."""
    seen, todo = set(), list(arrows_of[start])
    while todo:
        r = todo.pop()
        if r not in seen:
            seen.add(r)
            todo += arrows_of[r]
    return seen


def ordered(found):
    """All rooms, each after those that it uses, as far as there is such an order; lower floors first."""
    order, left = [], sorted(set(found) | {t for targets in found.values() for t in targets})
    while left:
        lowest = min(floor(r) for r in left)
        candidates = [r for r in left if floor(r) == lowest]
        missing = {r: {t for t in found[r] if t in candidates} for r in candidates}
        # Where none is without arrows upward, one that is on a circle has to begin.
        ready = [r for r in candidates if not missing[r]] or [r for r in candidates if r in reachable(missing, r)]
        order.append(min(ready, key=lambda r: (len(missing[r]), r)))
        left.remove(order[-1])
    return order


def upward(found, order):
    place = {r: n for n, r in enumerate(order)}
    return {(r, t) for r, targets in found.items() for t in targets if place[t] > place[r]}


def drawing(found, order, up):
    lines = ["| folder | uses in its own component | uses in other components |", "|---|---|---|"]
    for r in order:
        own = sorted(t for t in found[r] if floor(t) == floor(r))
        below = sorted(t for t in found[r] if floor(t) != floor(r))
        top = r.split("/")[0]
        short = [(t[len(top) + 1:] or t) + (" (exception)" if (r, t) in up else "") for t in own]
        lines.append(f"| `{r}` | {', '.join(short)} | {', '.join(below)} |")
    lines += ["", "Exceptions to the order:" + (" none." if not up else "")]
    lines += [textwrap.fill(f"- `{r}` uses `{t}`: {EXCEPTIONS.get((r, t), 'NO REASON GIVEN')}.", 100, subsequent_indent="  ",
                            break_on_hyphens=False) for r, t in sorted(up)]
    return "\n".join(lines).rstrip() + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("document", nargs="?", default=os.path.join(ROOT, "docs", "tables", "folders.md"))
    parser.add_argument("--check", action="store_true")
    args = parser.parse_args()
    found = arrows(sources())
    order = ordered(found)
    up = upward(found, order)
    problems = [f"{r} uses {t}, which is above it" for r, t in sorted(up - set(EXCEPTIONS))]
    problems += [f"the exception of {r} for {t} is not needed" for r, t in sorted(set(EXCEPTIONS) - up)]
    with open(args.document, encoding="utf-8") as f:
        text = f.read()
    if text.count(BEGIN) != 1 or text.count(END) != 1:
        sys.exit(f"house.py: error: {args.document}: has no place for the drawing, expected the lines {BEGIN.strip()} and {END.strip()}")
    wanted = text[:text.index(BEGIN) + len(BEGIN)] + drawing(found, order, up) + text[text.index(END):]
    if args.check and text != wanted:
        problems.append(f"{os.path.relpath(args.document, ROOT)} shows another house, expected what scripts/house.py writes")
    elif text != wanted:
        with open(args.document, "w", encoding="utf-8") as f:
            f.write(wanted)
    for problem in problems:
        print(f"house.py: error: {problem}", file=sys.stderr)
    sys.exit(1 if problems else 0)


if __name__ == "__main__":
    main()
