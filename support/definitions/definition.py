"""What the command line of each tool takes.

A definition is what a tool prints with --print-definition (support/Definition.cpp): `name`, `description`, `options`
and, of one that has some, `commands`, which are definitions themselves. LLVM's tools and those that read their
arguments themselves print a help text instead; it is read here into the same form.
"""

import json
import os
import re
import subprocess


def said(program, *arguments):
    done = subprocess.run([program, *arguments], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, text=True)
    return done.stdout if done.returncode == 0 else ""


def read(folder, tool):
    """The definition of a tool in a folder."""
    program = os.path.join(folder, tool)
    text = said(program, "--print-definition")
    if text.startswith("{"):
        return with_configuration(json.loads(text)["tool"], folder)
    return of_help(tool, said(program, "--help"))


def settings_of(schema, before=""):
    """Keys of a configuration with "=" behind them, each with the values that it has names for."""
    for key, value in schema["properties"].items():
        if value["type"] == "object":
            yield from settings_of(value, f"{before}{key}.")
        else:
            switch = ["0", "1"] if (value.get("minimum"), value.get("maximum")) == (0, 1) else []
            yield f"{before}{key}=", value.get("enum", switch)


def with_configuration(tool, folder):
    """The tool, with what vorion-sim knows of configurations where the names of values say that they are such."""
    for option in tool["options"]:
        value = option.get("value", {})
        if value.get("name") not in ("KEY=VALUE,...", "NAME|FILE") or "names" in value:
            continue
        settings = dict(settings_of(json.loads(said(os.path.join(folder, "vorion-sim"), "--print-config-schema"))))
        if value["name"] == "NAME|FILE":
            value["names"] = settings["machine="]
        else:
            value.update(kind="settings", settings=settings)
    return tool


# "  -o FILE   what it is", "  --name=<value>  - what it is", or the names alone, with the rest on the next line.
OPTION = re.compile(r"  (-\S(?:.*?\S)??)(?:\s{2,}(?:- )?(\S.*)|\s+- (\S.*))?$")
# "    =value  - what it is": of the option before it.
CHOICE = re.compile(r"    =(\S+)\s+-")


def of_help(tool, text):
    """The definition that a help text gives: all options, and those of the tool's own part apart."""
    own, _, llvm = text.partition("OVERVIEW:")
    lines = own.splitlines()
    while lines and not lines[-1]:
        lines.pop()
    footer = lines.pop() if lines and lines[-1].startswith("exit codes:") else ""
    usage = lines.pop(0).removeprefix("usage: ") if lines else ""
    at = next((n for n, line in enumerate(lines) if line.startswith("  ")), len(lines))
    overview = llvm.split("\n", 1)[0].strip()
    if not usage:
        usage = "".join(re.findall(r"^USAGE: (.*)", llvm, re.M)[:1])
    own_options = options_of(lines[at:], joined=True)
    known = {name for option in own_options for name in option["names"]}
    return {"name": tool, "usage": usage, "footer": footer, "options": own_options,
            "description": " ".join(line for line in lines[:at] if line and not line.startswith("Options are")) or overview,
            "others": [o for o in options_of(llvm.splitlines()) if o["names"] and not known.intersection(o["names"])]}


def options_of(lines, joined=False):
    """Of lines of a help text. Where help is `joined`, a line that is no option goes on with the one before it."""
    options = []
    for line in lines:
        found = OPTION.match(line)
        choice = CHOICE.match(line)
        if choice and options and options[-1].get("value"):
            options[-1]["value"]["kind"] = "one-of"
            options[-1]["value"].setdefault("words", []).append(choice[1])
        elif found:
            options.append(option_of(found[1], found[2] or found[3] or ""))
        elif options and line.startswith("   ") and (joined or not options[-1]["help"]):
            options[-1]["help"] = (options[-1]["help"] + " " + line.strip()).strip()
    return options


def option_of(spelled, text):
    names = []
    for part in spelled.split(", "):
        # Neither the dots of "-cl-..." nor what may follow a name.
        name = re.match(r"--?[A-Za-z0-9#+][\w.+-]*=?", part)
        if name and "..." not in part:
            names.append(name[0])
    value = re.search(r"[= <]+([^=<>, ]+)>?", spelled[1:])
    option = {"names": [n.rstrip("=") for n in names], "spelled": spelled, "help": text, "required": False,
              "repeats": False}
    if value:
        folder = re.search(r"dir|folder|path", value[1], re.I)
        file = re.search(r"file|output", value[1], re.I)
        option["value"] = {"name": value[1], "optional": False, "written": False,
                           "kind": "file" if file else "folder" if folder else "any",
                           "equals": any(n.endswith("=") for n in names)}
    return option
