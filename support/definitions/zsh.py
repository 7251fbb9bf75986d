"""Completion for zsh from definitions."""

import common


def quoted(text):
    return "'" + text.replace("'", "'\\''") + "'"


def escaped(text, characters):
    return "".join("\\" + c if c in characters + "\\" else c for c in text)


def action(value, tool):
    words = value.get("words", [])
    listed = " ".join(escaped(word, ":() ") for word in words)
    if value["kind"] == "one-of":
        return f"({listed})"
    if value["kind"] == "some-of":
        return f"_sequence compadd - {listed}"
    if value["kind"] == "settings":
        return f"_{function_of(tool)}_settings"
    if "names" in value:  # or a file
        names = " ".join(escaped(name, ":() ") for name in value["names"])
        files = action({"kind": "file", "words": words}, tool)
        return "{ compadd - " + names + "; " + files + " }"
    if value["kind"] == "view":
        return f"_{tool['name']}_views {listed}".rstrip()
    if value["kind"] == "file":
        # Folders, and files with the endings; of one ending, the brackets would be something else.
        return f'_files -g "*({"|".join(words)})"'.replace(f"({words[0]})", words[0]) if words else "_files"
    return {"prefix": "_files", "folder": "_files -/"}.get(value["kind"], " ")


def function_of(tool):
    return tool["name"].replace("-", "_")


def configuration(tool):
    """Functions for the options that take keys of a configuration."""
    for option in tool["options"]:
        value = option.get("value", {})
        if value.get("kind") == "settings":
            known = [quoted(f"{key.rstrip('=')}:value:({' '.join(values)})" if values else f"{key.rstrip('=')}:value: ")
                     for key, values in value["settings"].items()]
            yield f"_{function_of(tool)}_settings() {{ _values -s , setting " + " ".join(known) + "; }"


def specs(options, tool, with_positions=True):
    """What _arguments takes, one each name of an option."""
    at = 0
    for option in options:
        value = option.get("value")
        if "position" in option:
            at += 1
            if with_positions:
                yield f"{at}:{escaped(option['position'], ':')}:{action(value, tool)}"
            continue
        names = [name for name in option["names"] if common.is_plain(name)]
        others = names + option.get("excludes", [])
        for name in names:
            form = name
            argument = ""
            if value:
                by_equals = name.startswith("--") or value.get("equals")
                form += ("=-" if value["optional"] else "=") if by_equals else "+"
                colon = "::" if value["optional"] else ":"
                argument = f"{colon}{escaped(value['name'], ':')}:{action(value, tool)}"
            before = "*" if option["repeats"] else f"({' '.join(others)})" if len(others) > 1 else ""
            yield f"{before}{form}[{escaped(common.brief(option), '[]:')}]{argument}"
    if with_positions and not at and options and any("spelled" in o for o in options):
        yield "*:file:_files"


def arguments(specifications, indent, flags="-S"):
    lines = [f"{indent}_arguments {flags}"] + [f"{indent}  {quoted(s)}" for s in specifications]
    return " \\\n".join(lines)


def script(tool):
    name = tool["name"]
    commands = tool.get("commands", [])
    lines = [f"#compdef {name}", f"# Completion of {name} in zsh, made from the definition of its command line.", ""]
    if commands:
        lines += [f"_{name}_views() {{",
                  "  local -a views",
                  "  local file=${(Q)${opt_args[--cameras]}}",
                  "  [[ -z $file ]] || views=(${(f)\"$($service --print-views ${~file} 2>/dev/null)\"})",
                  "  views+=($@)",
                  "  _sequence compadd - $views", "}", ""]
    lines += configuration(tool)
    lines += [f"_{name}() {{", "  local curcontext=$curcontext state line", "  typeset -A opt_args"]
    if not commands:
        lines.append(arguments(specs(tool["options"] + tool.get("others", []), tool), "  ", "-S"))
    else:
        lines.append(arguments([*specs(tool["options"], tool, False), "1: :->command", "*:: :->argument"], "  ", "-C -S")
                     + " && return")
        lines += ["  case $state in", "  command)", "    local -a commands=("]
        lines += ["      " + quoted(f"{c['name']}:{escaped(c['description'], ':')}") for c in commands]
        lines += ["      " + quoted(f"{common.HELP}:{common.HELP_BRIEF}")]
        lines += ["    )", "    _describe command commands ;;", "  argument)", "    case $words[1] in"]
        for command in commands:
            lines += [f"    {command['name']})", arguments(specs(common.options_in(tool, command), tool), "      "),
                      "      ;;"]
        lines += [f"    {common.HELP})", arguments([f"1:command:({' '.join(c['name'] for c in commands)})"], "      "),
                  "      ;;"]
        lines += ["    esac ;;", "  esac"]
    lines += ["}", "", f"_{name} \"$@\""]
    return "\n".join(lines) + "\n"
