"""Pages of the site that the tools themselves give: options, exit codes, the machine's values."""

import json
import os
import re
import subprocess

TOOLS = ("splat", "vorion-sim", "vorion-clang", "vorion-link")


def said(tools, *command):
    """What a tool prints on standard output."""
    return subprocess.run([os.path.join(tools, command[0]), *command[1:]], check=True, stdout=subprocess.PIPE,
                          text=True).stdout


def options(tools):
    yield "# Options\n\nThis page is what each tool says with `--help`.\n"
    for tool in (t for t in TOOLS if os.path.exists(os.path.join(tools, t))):
        text = said(tools, tool, "--help")
        yield f"\n## {tool}\n\n```text\n{text.strip()}\n```\n"
        listed = re.search(r"^Subcommands:\n((?:  .*\n)+)", text, re.M)
        for command in re.findall(r"^  ([a-z-]+)", listed[1], re.M) if listed else ():
            yield f"\n### {tool} {command}\n\n```text\n{said(tools, tool, command, '--help').strip()}\n```\n"


def exit_codes(root):
    """The section of the README, whose table is the one that people read."""
    with open(os.path.join(root, "README.md"), encoding="utf-8") as f:
        section = re.search(r"^### Errors\n(.*?)^##? ", f.read(), re.M | re.S)[1]
    yield "# Exit codes\n" + section


def values(schema, name=""):
    """(name, range) of each value that a schema describes."""
    for key, part in schema.get("properties", {}).items():
        if "properties" in part:
            yield from values(part, f"{name}{key}.")
        else:
            yield name + key, part


def limits(part):
    if "enum" in part:
        return ", ".join(f"`{json.dumps(v)}`" for v in part["enum"])
    ends = [part.get(end) for end in ("minimum", "maximum")]
    return f"{ends[0]} to {ends[1]}" if None not in ends else part.get("type", "")


def machine(tools):
    schema = json.loads(said(tools, "vorion-sim", "--print-config-schema"))
    yield ("# Values of the machine\n\n`VORION_SET=NAME=VALUE`, or `vorion-sim --set NAME=VALUE`, changes one. "
           "`vorion-sim --print-config-schema` prints their JSON schema.\n\n"
           "| name | default | values |\n|---|--:|---|\n")
    for name, part in values(schema):
        yield f"| `{name}` | `{json.dumps(part.get('default'))}` | {limits(part)} |\n"


def write(root, tools, pages):
    """The pages in pages/docs/reference; without tools, those that need none."""
    folder = os.path.join(pages, "docs", "reference")
    os.makedirs(folder)
    made = {"exit-codes.md": exit_codes(root)}
    if os.path.exists(os.path.join(tools, "splat")) and os.path.exists(os.path.join(tools, "vorion-sim")):
        made |= {"options.md": options(tools), "machine.md": machine(tools)}
    for name, parts in made.items():
        with open(os.path.join(folder, name), "w", encoding="utf-8") as f:
            f.write("".join(parts).replace("](docs/", "](../"))
