#!/usr/bin/env python3
"""manual.py BUILD: what is wrong with the pages of the manual."""

import json
import os
import re
import subprocess
import sys

build = sys.argv[1]
folder = os.path.join(build, "share", "man", "man1")
problems = []


def run(*command):
    """What a formatter makes, and what it says of it."""
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                          env=dict(os.environ, LC_ALL="C.UTF-8", MANWIDTH="80"))
    return done.stdout, done.stderr


def commands(tool):
    """(words, definition) of a tool and its subcommands."""
    text = subprocess.run([os.path.join(build, "bin", tool), "--print-definition"], stdout=subprocess.PIPE,
                          stderr=subprocess.DEVNULL, text=True).stdout
    definition = json.loads(text)["tool"]
    yield [tool], definition
    for command in definition.get("commands", []):
        yield [tool, command["name"]], command


installed = set()
for place, _, files in os.walk(build):
    if "cmake_install.cmake" in files:
        with open(os.path.join(place, "cmake_install.cmake"), encoding="utf-8") as file:
            installed |= set(re.findall(r'/bin/((?:splat|vorion-|sample-)[a-z-]*)"', file.read()))
pages = {name.removesuffix(".1") for name in os.listdir(folder)}
problems += [f"{name}: no page" for name in sorted(installed - pages)]
options = 0
for tool in ("splat", "vorion-sim"):
    for words, definition in commands(tool):
        page = "-".join(words)
        if page not in pages:
            problems.append(f"{page}: no page")
            continue
        with open(os.path.join(folder, page + ".1"), encoding="utf-8") as file:
            text = file.read().replace("\\-", "-")
        for name in (n for option in definition["options"] for n in option["names"]):
            options += 1
            if f"\\fB{name}\\fR" not in text:
                problems.append(f"{page}: no {name}")
for page in sorted(pages):
    path = os.path.join(folder, page + ".1")
    lint, _ = run("mandoc", "-T", "lint", "-W", "warning", path)
    text, warnings = run("man", "--warnings", "-l", path)
    problems += [f"{page}: {line}" for line in (lint + warnings).splitlines()]
    if " docs/" in text and "/usr/share/doc/vorion/docs/" not in text.partition("\nFILES\n")[2]:
        problems.append(f"{page}: FILES does not say where docs/ is")
    problems += [f"{page}: no {part}" for part in ("NAME", "SYNOPSIS", "DESCRIPTION", "SEE ALSO") if f"\n{part}\n" not in text]
for problem in problems:
    print(problem)
print(f"{len(pages)} pages, {options} options, {len(problems) or 'nothing'} {'are' if problems else 'is'} wrong")
