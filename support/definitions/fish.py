"""Completion for fish from definitions."""

import common


def quoted(text):
    return "'" + text.replace("\\", "\\\\").replace("'", "\\'") + "'"


def name_flag(name):
    if name.startswith("--"):
        return "-l " + name[2:]
    return ("-s " if len(name) == 2 else "-o ") + name[1:]


def value_flags(value, tool):
    words = value.get("words", [])
    listed = " ".join(words + value.get("names", []))
    if value["kind"] == "settings":
        known = [key + v for key, values in value["settings"].items() for v in ["", *values]]
        return "-x -a " + quoted(f"(__fish_append , {' '.join(known)})")
    needs = "" if value["optional"] else "-x "
    if value["kind"] == "one-of":
        return f"{needs}-a {quoted(listed)}"
    if value["kind"] == "some-of":
        return f"{needs}-a {quoted(f'(__fish_append , {listed})')}"
    if value["kind"] == "view":
        views = f"__vorion_{tool}_views {listed}".rstrip()
        return "-x -a " + quoted(f"(__fish_append , ({views}))" if "delimiter" in value else f"({views})")
    if value["kind"] == "folder":
        return "-x -a '(__fish_complete_directories)'"
    if value["kind"] == "file" and words:
        return "-r -k -a " + quoted(" ".join([*(f"(__fish_complete_suffix {w})" for w in words), *value.get("names", [])]))
    if value["kind"] in ("file", "prefix"):
        return "-F" if value["optional"] else "-r -F"
    return "" if value["optional"] else "-x"


def options(tool, given, condition=""):
    for option in given:
        names = [name for name in option["names"] if common.is_plain(name)]
        if not names:
            continue
        parts = [f"complete -c {tool['name']}", condition, *map(name_flag, names)]
        if "value" in option:
            parts.append(value_flags(option["value"], tool["name"]))
        parts.append("-d " + quoted(common.brief(option)))
        yield " ".join(part for part in parts if part)


def script(tool):
    name = tool["name"]
    lines = [f"# Completion of {name} in fish, made from the definition of its command line."]
    commands = tool.get("commands", [])
    if not commands:
        lines += options(tool, tool["options"] + tool.get("others", []))
        return "\n".join(lines) + "\n"
    listed = " ".join(c["name"] for c in commands)
    lines += ["", f"function __vorion_{name}_views", "    set -l words (commandline -opc)",
              "    set -l file (string replace -rf -- '^--cameras=' '' $words)",
              "    set -l at (contains -i -- --cameras $words)",
              "    and set -a file $words[(math $at + 1)]",
              "    printf '%s\\n' $argv",
              "    set -q file[1]; and $words[1] --print-views $file[-1] 2>/dev/null", "end", ""]
    none = f"-n 'not __fish_seen_subcommand_from {listed}'"
    lines += [f"complete -c {name} {none} -f -a {c['name']} -d {quoted(c['description'])}" for c in commands]
    lines.append(f"complete -c {name} {none} -f -a {common.HELP} -d {quoted(common.HELP_BRIEF)}")
    lines += options(tool, tool["options"], none)
    for command in commands:
        inside = f"-n '__fish_seen_subcommand_from {command['name']}'"
        lines += options(tool, common.options_in(tool, command), inside)
    return "\n".join(lines) + "\n"
