#!/usr/bin/env python3
"""Follows one of the pages docs/adding-*.md in a copy of the repository.

usage: follow.py [--all] PAGE FOLDER
FOLDER is made anew. A fenced text of the page is put where the line before it says:

    At the end of `FILE`:
    In `FILE`, before `LINE`:
    In `FILE`, after `LINE`:

A file that is not there is made. LINE is the beginning of a line, without what it is indented by; one that has a `
stands between two of them and a space. Texts of language
sh are commands, and are run; "sh minutes" is run with --all alone.
Exit codes: 0 all as the page says, 1 not, 2 usage.
"""

import argparse
import os
import re
import shutil
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
STEP = re.compile(r"(?:^ *(?:At the end of|In) `([^`]+)`(?:, (before|after) (?:`([^`]+)`|`` ([^\n]+) ``))?:\n\n)?"
                  r"^( *)```([a-z+]+)( minutes)?\n(.*?)^ *```$", re.M | re.S)


def fail(text):
    print(f"follow.py: error: {text}", file=sys.stderr)
    sys.exit(1)


def copy_repository(folder, sources):
    """All but what is built; the unpacked sources are shown where a build looks for them."""
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(ROOT, folder, ignore=lambda place, names: {"build", ".git"} & set(names) if place == ROOT else ())
    os.makedirs(os.path.join(folder, "build"))
    os.symlink(os.path.abspath(sources), os.path.join(folder, "build", "sources"))


def place_of(text, side, line, where):
    """The offset in text before or after the one line that begins with line."""
    found = list(re.finditer(rf"^[ \t]*{re.escape(line)}.*\n", text, re.M))
    if len(found) != 1:
        fail(f"{where}: {len(found)} lines begin with '{line}', expected one")
    return found[0].start() if side == "before" else found[0].end()


def put(folder, file, side, line, body):
    path = os.path.join(folder, file)
    text = ""
    if side or os.path.exists(path):
        with open(path, encoding="utf-8") as opened:
            text = opened.read()
    at = place_of(text, side, line, file) if side else len(text)
    with open(path, "w", encoding="utf-8") as opened:
        opened.write(text[:at] + ("\n" if text and not side else "") + body + text[at:])
    print(f"put into {file}")


def run(folder, commands):
    done = subprocess.run(["bash", "-ec", commands], cwd=folder, text=True, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT)
    if done.returncode:
        fail(f"a command of these ended with {done.returncode}:\n{commands}\n{done.stdout[-4000:]}")
    print(done.stdout[-4000:], end="")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--all", action="store_true")
    parser.add_argument("--sources", default=os.path.join(ROOT, "build", "sources"), help="unpacked sources")
    parser.add_argument("page")
    parser.add_argument("folder")
    options = parser.parse_args()
    folder = os.path.abspath(options.folder)
    copy_repository(folder, options.sources)
    with open(os.path.join(folder, options.page), encoding="utf-8") as page:
        text = page.read()
    for file, side, plain, quoted, indent, language, minutes, body in STEP.findall(text):
        body = re.sub(f"^{indent}", "", body, flags=re.M)
        if file:
            put(folder, file, side, plain or quoted, body)
        elif language != "sh":
            fail(f"{options.page}: the text '{body.splitlines()[0]}' has no place")
        elif options.all or not minutes:
            run(folder, body)


if __name__ == "__main__":
    main()
