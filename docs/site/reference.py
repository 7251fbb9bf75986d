"""Pages of the site that the tools themselves give: options, exit codes, the machine's values."""

import html
import json
import os
import re
import subprocess
import sys

DEFINITIONS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "support", "definitions")

TOOLS = ("splat", "vorion-sim", "vorion-clang", "vorion-link")


def said(tools, *command):
    """What a tool prints on standard output."""
    return subprocess.run([os.path.join(tools, command[0]), *command[1:]], check=True, stdout=subprocess.PIPE,
                          text=True).stdout


def code(text):
    """Text as it is, also in a table, whose columns a bar would end."""
    return "<code>" + html.escape(text, quote=False).replace("|", "&#124;").replace("*", "&#42;") + "</code>" if text else ""


def plain(text):
    """A help text in a cell of a table."""
    text = html.escape(" ".join(text.split()), quote=False)
    return re.sub(r"[|*_`\[\]]", lambda m: f"&#{ord(m[0])};", text)


def rows(options, remarks):
    yield "\n| option | value | what it does |\n|---|---|---|\n"
    for option in options:
        names = option.get("spelled") or option.get("position") or ", ".join(option["names"])
        value = "" if "spelled" in option else option.get("value", {}).get("name", "")
        said = [plain(option["help"]), *map(plain, remarks(option))]
        if said[1:] and said[0][-1:] not in ".:":
            said[0] += "."
        yield f"| {code(names)} | {code(value)} | {' '.join(said)} |\n"


def options(tools):
    # Where there are tools, there is the folder that knows how to ask them.
    sys.path.insert(0, DEFINITIONS)
    import definition
    import manual

    yield "# Options\n\nThis page is made of the definitions of the tools' command lines, as are their pages of the manual.\n"
    for tool in (t for t in TOOLS if os.path.exists(os.path.join(tools, t))):
        defined = definition.read(tools, tool)
        yield f"\n## {tool}\n\n{plain(defined['description'].rstrip('.'))}.\n"
        yield from rows(defined["options"], manual.remarks)
        for command in defined.get("commands", []):
            yield f"\n### {tool} {command['name']}\n\n{plain(command['description'])}.\n"
            yield from rows(command["options"], manual.remarks)


def exit_codes(root):
    """The section of docs/command-line.md, whose table is the one that people read."""
    with open(os.path.join(root, "docs", "command-line.md"), encoding="utf-8") as f:
        section = re.search(r"^## Errors\n(.*?)(?:^##? |\Z)", f.read(), re.M | re.S)[1]
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
