#!/usr/bin/env python3
"""Makes pages of the manual and completion for shells from the definitions of command lines.

usage: make.py SHARE VERSION TOOLS [TOOL...]
SHARE gets man/man1, bash-completion/completions, zsh/site-functions and fish/vendor_completions.d. TOOLS is the folder
of the tools, which are asked for their definitions. What notes.toml says of them is added to the pages.
Exit codes: 0 done, 1 notes.toml names what no tool has, 2 usage.
"""

import os
import re
import shlex
import sys
import tomllib

import bash
import definition
import fish
import manual
import zsh

HERE = os.path.dirname(os.path.abspath(__file__))


def write(folder, name, text):
    os.makedirs(folder, exist_ok=True)
    with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
        file.write(text)


def wrong_examples(tool, notes):
    """Examples that have options which the tool does not."""
    for command in notes.get("examples", {}):
        words = shlex.split(command)
        known = {name for part in (tool, *tool.get("commands", [])) if part["name"] in words
                 for option in part["options"] + part.get("others", []) for name in option["names"]}
        for word in words:
            name = re.match(r"--[a-z][\w-]*|-[a-z]$", word)
            if name and name[0] not in known:
                yield f"the example '{command}' has {name[0]}, expected an option that there is"


def pages(tool, notes, names):
    """(words of the command, its definition, its notes) of each page of a tool, but samples, which have no options. A
    command that is a program of its own has that one's page."""
    name = tool["name"]
    yield [name], tool, notes.get(name, {})
    for command in tool.get("commands", []):
        if f"{name}-{command['name']}" not in names:
            yield [name, command["name"]], command, notes.get(f"{name} {command['name']}", {})


def with_programs(tool, folder, names):
    """The tool, with the options of those of its commands that are programs of their own."""
    for command in tool.get("commands", []):
        program = f"{tool['name']}-{command['name']}"
        if program in names:
            command.update(options=definition.read(folder, program)["options"])
    return tool


def main():
    if len(sys.argv) < 4:
        print(__doc__, file=sys.stderr)
        return 2
    share, version, folder, *names = sys.argv[1:]
    with open(os.path.join(HERE, "notes.toml"), "rb") as file:
        notes = tomllib.load(file)
    problems = []
    for name in names:
        # Samples have neither options nor a help; their notes are all that there is.
        sample = name.startswith("sample-")
        tool = ({"name": name, "description": notes[name]["brief"], "options": [], "footer": ""} if sample
                else with_programs(definition.read(folder, name), folder, names))
        made = list(pages(tool, notes, names))
        for words, part, said in made:
            others = ["-".join(w) + ".1" for w, _, _ in made if w != words] if len(words) == 1 else [f"{name}.1"]
            also = sorted({*others, *said.get("see", []), *notes.get(name, {}).get("see", [])} - {"-".join(words) + ".1"})
            problems += wrong_examples(tool, said)
            write(os.path.join(share, "man", "man1"), "-".join(words) + ".1", manual.page(words, part, said, (version, notes["date"]), also))
        if not sample:
            write(os.path.join(share, "bash-completion", "completions"), name, bash.script(tool))
            write(os.path.join(share, "zsh", "site-functions"), "_" + name, zsh.script(tool))
            write(os.path.join(share, "fish", "vendor_completions.d"), name + ".fish", fish.script(tool))
    for problem in problems:
        print(f"make.py: error: {problem}", file=sys.stderr)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
