#!/usr/bin/env python3
"""Does what a page says, as somebody who reads it in a shell that is new and stands in the repository.

usage: tutorial.py [--all] [--tables] [--within PERCENT] [--without START]... [--installed TREE | --put NAME=FILE...] PAGE FOLDER
FOLDER is made anew. It shows the repository and its build, and has a build/ of its own for what the page writes.
A fenced text of the page is

    sh          commands, which run in order in one shell; "sh minutes" runs with --all alone
    text        what the commands before it print. A line "..." stands for any lines, "..." in a line for any text
    console     commands with names of the reader's own, which are not run
    c, python   part of the file whose name stands in the lines before it, from the repository's root or the samples'

A number with commas, such as 95,435, that stands in a sentence must be in what the commands print. With --put it need
not be, because another file stands for the one that the page speaks of.
With --tables the commands in tables run, too: the last cell of a row, if it is one text of code that begins with the name
of a tool, and has no word in capitals, for which the reader puts something else. --without leaves
out those that begin so, for example because they do not end by themselves.
--installed TREE stands for somebody who has the installed tree alone, and types its env.sh.
--put gives a page a file that it expects and that takes long to make.
--within PERCENT holds numbers of printed texts to the page's within a part, for pages with figures of the clock. Numbers with
a decimal point may differ by 1, too.
Exit codes: 0 all as the page says, 1 not, 2 usage.
"""

import argparse
import os
import re
import shutil
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))))
SAMPLES = os.path.join(ROOT, "apps", "samples")
TEXT = re.compile(r"^( *)```(\w+)( minutes)?\n(.*?)^ *```$", re.M | re.S)
ROW = re.compile(r"^\|.*\| `((?:splat|vorion-\w+) [^`]*)` \|$", re.M)
# As sentences write what was counted.
COUNT = re.compile(r"(?<![\w.,])\d{1,3}(?:,\d{3})+(?![\w,]*\d)")
NUMBER = re.compile(r"(\d+(?:\.\d+)?)")
PLACEHOLDER = re.compile(r"(?<![$\w])[A-Z]{3,}\b")


def fail(text):
    print(f"tutorial.py: error: {text}", file=sys.stderr)
    sys.exit(1)


def show_repository(folder, build, put):
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(os.path.join(folder, "build"))
    for name in os.listdir(ROOT):
        if name != "build" and not name.startswith("."):
            os.symlink(os.path.join(ROOT, name), os.path.join(folder, name))
    os.symlink(os.path.abspath(build), os.path.join(folder, "build", "dev"))
    for name, file in put:
        os.makedirs(os.path.dirname(os.path.join(folder, name)), exist_ok=True)
        shutil.copy(file, os.path.join(folder, name))


def line_pattern(line):
    return ".*".join(map(re.escape, line.split("..."))) + "\n"


def printed_pattern(text):
    lines = (line.rstrip() for line in text.splitlines())
    return "".join("(?:.*\n)*?" if line == "..." else line_pattern(line) for line in lines)


def is_near(page, ours, percent):
    """Whether a number is near the page's: within the percentage or, with a decimal point as shares of time have it, within 1."""
    return abs(float(page) - float(ours)) <= max(percent / 100 * float(page), 1 if "." in page else 0)


def is_printed(text, output, percent):
    """Whether a page's text is what was printed. With a percentage, blanks do not count, and numbers need only be near."""
    if percent is None:
        return re.fullmatch(printed_pattern(text), output)
    page, ours = (NUMBER.split(re.sub(r"[ \t]+", " ", part)) for part in (text, output))
    return page[::2] == ours[::2] and all(is_near(a, b, percent) for a, b in zip(page[1::2], ours[1::2]))


class Step:
    def __init__(self, commands, line):
        self.commands, self.line, self.printed = commands, line, None


def in_tables(text, without):
    """The commands in the tables of a part of a page."""
    return [Step(row[1] + "\n", None) for row in ROW.finditer(text)
            if not PLACEHOLDER.search(row[1]) and not row[1].startswith(without)]


def steps_of(page, text, every, tables, without):
    """The commands of a page with what they print; says which part of a file is not as the page shows it."""
    steps, skipped, end = [], False, 0
    for found in TEXT.finditer(text):
        if tables:
            steps += in_tables(text[end:found.start()], without)
        end = found.end()
        indent, language, minutes, body = found.groups()
        body = re.sub(f"^{indent}", "", body, flags=re.M)
        line = text.count("\n", 0, found.start()) + 1
        if language == "sh":
            skipped = bool(minutes) and not every
            if not skipped:
                steps.append(Step(body, line))
        elif language == "text" and not skipped:
            if not steps or steps[-1].printed is not None:
                fail(f"{page}:{line}: the output of no command")
            steps[-1].printed = body
        elif language not in ("text", "console"):
            named = re.findall(r"`([^`\s]+)`", text[:found.start()].rstrip().rsplit("\n\n", 1)[-1])
            files = [f for f in (os.path.join(r, n) for n in named for r in (ROOT, SAMPLES)) if os.path.isfile(f)]
            if not files:
                fail(f"{page}:{line}: a text of {language}, but the lines before it name no file")
            with open(files[-1], encoding="utf-8") as f:
                if body not in f.read():
                    fail(f"{page}:{line}: {os.path.relpath(files[-1], ROOT)} does not have this text")
    return steps + (in_tables(text[end:], without) if tables else [])


def counts_of(text):
    """The numbers with commas outside of a page's fenced texts and tables, each with its line."""
    prose = TEXT.sub(lambda found: "\n" * found[0].count("\n"), text)
    prose = re.sub(r"^\|.*", "", prose, flags=re.M)
    return [(found[0], prose.count("\n", 0, found.start()) + 1) for found in COUNT.finditer(prose)]


def hold_counts(page, counts, outputs):
    printed = set(re.findall(r"\d+", re.sub(r"(?<=\d),(?=\d{3})", "", "\n".join(outputs))))
    for count, line in counts:
        if count.replace(",", "") not in printed:
            fail(f"{page}:{line}: no command prints {count}")


def run(page, steps, folder, percent=None):
    """Runs the steps and compares what they print, which it returns."""
    # As a new shell has it: no variable of ours is set.
    kept = {name: os.environ[name] for name in ("LANG", "TMPDIR", "POCL_CACHE_DIR") if name in os.environ}
    script = "set -e\n" + "".join(f"printf '\\036'\n{step.commands}" for step in steps)
    # Debian 13's PyOpenCL warns that a hash of its own is not packaged.
    told = dict(kept, HOME=os.path.expanduser("~"), PATH="/usr/local/bin:/usr/bin:/bin:/sbin", PYTHONWARNINGS="ignore")
    done = subprocess.run(["bash", "-c", script], cwd=folder, env=told, stdin=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    outputs = done.stdout.decode("utf-8", "replace").split("\036")[1:]
    if done.returncode:
        failed = steps[len(outputs) - 1]
        fail(f"{page}:{failed.line or 'table'}: a command ended with {done.returncode}:\n{failed.commands}"
             f"{outputs[-1][-4000:]}")
    for step, output in zip(steps, outputs):
        output = re.sub(r"[ \r]+$", "", output, flags=re.M)
        if step.printed is not None and not is_printed(step.printed, output, percent):
            fail(f"{page}:{step.line}: these commands\n{step.commands}print\n{output}the page says\n{step.printed}")
    return outputs


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--all", action="store_true")
    parser.add_argument("--tables", action="store_true")
    parser.add_argument("--within", type=float, metavar="PERCENT")
    parser.add_argument("--without", action="append", default=[])
    parser.add_argument("--build", default=os.path.join(ROOT, "build", "dev"))
    parser.add_argument("--installed")
    parser.add_argument("--put", action="append", default=[], type=lambda v: v.split("=", 1))
    parser.add_argument("page")
    parser.add_argument("folder")
    options = parser.parse_args()
    with open(os.path.join(ROOT, options.page), encoding="utf-8") as f:
        text = f.read()
    steps = steps_of(options.page, text, options.all, options.tables, tuple(options.without))
    if not steps:
        fail(f"{options.page} has no command")
    if options.installed:
        shutil.rmtree(options.folder, ignore_errors=True)
        os.makedirs(options.folder)
        for step in steps:
            step.commands = step.commands.replace(". scripts/env.sh", f". {options.installed}/share/vorion/env.sh")
    else:
        show_repository(options.folder, options.build, options.put)
    outputs = run(options.page, steps, options.folder, options.within)
    if not options.put:
        hold_counts(options.page, counts_of(text), outputs)
    print(f"{options.page}: {len(steps)} steps, {sum(s.printed is not None for s in steps)} outputs as the page says")


if __name__ == "__main__":
    main()
