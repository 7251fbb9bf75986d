#!/usr/bin/env python3
"""Runs the first command of every page in docs/ and of the README: of a user's page in an installed tree, of a developer's
page in a folder that shows the repository and its build.

usage: first_commands.py [--all] [--only PAGE]... --build BUILD --installed TREE FOLDER
A page is a developer's if its first command names a file of the repository, or builds it; every other command must be there
after an installation. The first command is the first line of the first text of `sh` that does more than to prepare the
shell, with the lines before it. What takes over half a minute is marked "sh minutes" on its page, and runs with --all alone.
FOLDER is made anew. It has what pages take for granted: scene.ply, cameras.json, photographs in photographs/ and capture/,
and the files of the documents' example of a project.
Prints a line for each page, and a count. Exit codes: 0 every command ended with 0, 1 some did not, 2 usage.
"""

import argparse
import glob
import os
import re
import shutil
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))))
TEXT = re.compile(r"^( *)```(\w+)( minutes)?\n(.*?)^ *```$", re.M | re.S)
# Lines that only prepare the shell.
PREPARES = re.compile(r"\. scripts/env\.sh|cd |mkdir |cat >|head |\w+=\S*\"?[^\s\"]*\"?\s*(#.*)?$|\w+=\"[^\"]*\"$|#|$")


def logical_lines(text):
    """The lines of a text of commands, each with those that continue it."""
    lines, waits = [], None
    for line in text.splitlines():
        if waits is not None or (lines and (lines[-1].endswith("\\") or lines[-1].count('"') % 2)):
            lines[-1] += "\n" + line
            if line == waits:
                waits = None
            continue
        lines.append(line)
        heredoc = re.search(r"<<\s*'?(\w+)'?", line)
        waits = heredoc[1] if heredoc else None
    return lines


def first_command(text):
    """(whether it takes minutes, the lines up to the first command and with it) of a page; None if it has none."""
    lines = []
    for found in TEXT.finditer(text):
        if found[2] != "sh":
            continue
        for line in logical_lines(re.sub(f"^{found[1]}", "", found[4], flags=re.M)):
            lines.append(line)
            if not PREPARES.match(line):
                return bool(found[3]), lines
    return (False, lines) if lines else None


def is_developers(command):
    words = [w for w in command.split() if not re.match(r"\w+=", w)]
    return words[0] in ("cmake", "ninja") or any(
        not w.startswith(("..", "/")) and "/" in w and (w.startswith("build/dev/") or os.path.exists(os.path.join(ROOT, w)))
        for w in words)


def prepare(folder, build, tree):
    shutil.rmtree(folder, ignore_errors=True)
    for part in ("user", "samples", os.path.join("developer", "build")):
        os.makedirs(os.path.join(folder, part))
    user, developer = os.path.join(folder, "user"), os.path.join(folder, "developer")
    samples = os.path.join(folder, "samples")
    program = os.path.join(build, "bin", "splat")
    subprocess.run([program, "demo-scene", "--gaussians", "1000", "-o", os.path.join(user, "scene.ply"), "--cameras",
                    os.path.join(user, "cameras.json")], check=True, stdout=subprocess.DEVNULL)
    for part in ("seeds", "captures"):
        os.makedirs(os.path.join(samples, part))
    subprocess.run([program + "-capture-samples", samples], check=True, stdout=subprocess.DEVNULL)
    for name in ("photographs", "capture"):
        shutil.copytree(os.path.join(samples, "captures", "transforms"), os.path.join(user, name))
    os.makedirs(os.path.join(user, "build", "demo"))
    for name in ("scene.ply", "cameras.json"):
        shutil.copy(os.path.join(user, name), os.path.join(user, "build", "demo"))
    shutil.copytree(os.path.join(tree, "share", "doc", "vorion", "examples", "downstream"), user, dirs_exist_ok=True)
    for name in os.listdir(ROOT):
        if name != "build" and not name.startswith("."):
            # Some commands write there.
            (shutil.copytree if name == "docs" else os.symlink)(os.path.join(ROOT, name), os.path.join(developer, name))
    os.symlink(build, os.path.join(developer, "build", "dev"))
    return user, developer


def run(lines, folder):
    """How a new shell in the folder ends, and what it prints."""
    kept = {name: os.environ[name] for name in ("LANG", "TMPDIR", "POCL_CACHE_DIR") if name in os.environ}
    done = subprocess.run(["bash", "-c", "set -e\n" + "\n".join(lines)], cwd=folder, stdin=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace",
                          env=dict(kept, HOME=os.path.expanduser("~"), PATH="/usr/local/bin:/usr/bin:/bin:/sbin"))
    return done.returncode, done.stdout


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--all", action="store_true")
    parser.add_argument("--only", action="append", default=[])
    parser.add_argument("--build", required=True)
    parser.add_argument("--installed", required=True)
    parser.add_argument("folder")
    options = parser.parse_args()
    tree = os.path.abspath(options.installed)
    user, developer = prepare(os.path.abspath(options.folder), os.path.abspath(options.build), tree)
    # test/adding does what the pages adding-*.md say, step by step.
    pages = ["README.md", *sorted(os.path.relpath(p, ROOT) for part in ("docs", "docs/tutorials")
                                  for p in glob.glob(os.path.join(ROOT, part, "*.md"))
                                  if not os.path.basename(p).startswith("adding-"))]
    counts, failed = {"user": 0, "developer": 0, "left out": 0}, 0
    for page in pages:
        with open(os.path.join(ROOT, page), encoding="utf-8") as file:
            text = file.read()
        first = first_command(text)
        if not first or (options.only and page not in options.only):
            continue
        minutes, lines = first
        shown = lines[-1].split("\n")[0]
        # The viewer does not end by itself, and has tests of its own.
        if (minutes and not options.all) or lines[-1].startswith("splat view"):
            counts["left out"] += 1
            continue
        if "../shared/data" in lines[-1] and not os.path.isdir(os.path.join(ROOT, "..", "shared", "data")):
            counts["left out"] += 1
            continue
        kind = "developer" if is_developers(lines[-1]) else "user"
        if kind == "user":
            lines = [f". {tree}/share/vorion/env.sh"] + [l for l in lines if l != ". scripts/env.sh"]
        else:
            lines = [". scripts/env.sh"] + [l for l in lines if l != ". scripts/env.sh"]
        code, said = run(lines, user if kind == "user" else developer)
        counts[kind] += 1
        print(f"{page}: {kind}: {shown}: {'done' if code == 0 else f'ended with {code}'}", flush=True)
        if code:
            failed += 1
            print("".join(f"    {line}\n" for line in said.splitlines()[-12:]), end="")
    print(", ".join(f"{count} {kind}" for kind, count in counts.items()) + f"; {failed or 'none'} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
