"""Pages of the manual, section 1, from definitions."""

import re

# What reports, checks of man(7) and old terminals take.
WIDTH = 78


def escape(text):
    """Text as roff takes it in the middle of a line."""
    text = text.replace("\\", "\\e").replace("-", "\\-")
    return text.replace("'", "\\(aq").replace("`", "\\(ga").replace("~", "\\(ti").replace("^", "\\(ha")


def paragraph(text):
    """Text of whole lines; no line is a request, and each sentence begins a line of its own."""
    lines = []
    for given in text.split("\n"):
        if lines:
            lines.append(".br")
        for sentence in re.split(r"(?<=[.;:]) +(?=[A-Z])", " ".join(given.split())):
            words = escape(sentence).split(" ")
            line = words.pop(0)
            for word in words:
                if len(line) + len(word) >= WIDTH:
                    lines.append(line)
                    line = word
                else:
                    line += " " + word
            lines.append(line)
    return "\n".join("\\&" + line if line[:1] in (".", "\\") and line != ".br" and not line.startswith("\\-") else line
                     for line in lines)


def bold(text):
    return "\\fB" + escape(text) + "\\fR"


def italic(text):
    return "\\fI" + escape(text) + "\\fR"


def value_of(option):
    value = option.get("value")
    if not value:
        return ""
    name = value["name"]
    return escape(name) if value["optional"] else italic(name)


def spelled(option):
    """The option's names and its value."""
    if "spelled" in option:  # as a help text has it
        return ", ".join(re.sub(r"^(\\fB)?(--?[^ =\[<]+)", lambda m: bold(m[2]), part, count=1)
                         if part.startswith("-") else part for part in option["spelled"].split(", "))
    if "position" in option:
        return italic(option["position"])
    names = ", ".join(bold(name) for name in option["names"])
    value = value_of(option)
    return names + ("" if not value or option["value"]["optional"] else " ") + value


def remarks(option):
    """What else a definition says of an option, in sentences."""
    value = option.get("value", {})
    words = value.get("words", [])
    if value.get("kind") == "one-of" and not value["optional"] and "|" not in value["name"]:
        yield "One of " + ", ".join(words) + "."
    if "range" in value:
        yield "From " + value["range"].replace("..", " to ") + "."
    if option["required"]:
        yield "Required."
    if option["repeats"]:
        yield "May be given several times."
    if "needs" in option:
        yield "Needs " + ", ".join(option["needs"]) + "."
    if "excludes" in option:
        yield "Not with " + ", ".join(option["excludes"]) + "."


def entry(option):
    text = option["help"].strip()
    said = list(remarks(option))
    if said and text and text[-1] not in ".:":
        text += "."
    return ".TP\n" + spelled(option) + "\n" + (paragraph(" ".join([text, *said])) or "\\&")


def entries(options, title="OPTIONS"):
    """Sections for options: those without a group, then the groups."""
    groups = {}
    for option in options:
        groups.setdefault(option.get("group", ""), []).append(option)
    for group, members in groups.items():
        yield f".SH {title}" if not group else ".SS " + escape(group)
        yield from map(entry, members)


def synopsis(words, definition):
    """How a command is called: what it needs, then that there is more."""
    parts = [bold(" ".join(words))]
    for option in definition["options"]:
        if "position" in option:
            parts.append(spelled(option) if option["required"] else f"[{spelled(option)}]")
        elif option["required"]:
            parts.append(bold(option["names"][0]) + " " + value_of(option))
    parts.append("[" + italic("OPTION") + "]...")
    if "commands" in definition:
        parts.append(italic("COMMAND"))
        parts.append("[" + italic("ARGUMENT") + "]...")
    return " ".join(parts)


def exit_status(footer):
    """From the line that ends every help: "exit codes: 0 ok, 1 ..."."""
    first, _, rest = footer.partition("\n")
    if not first.startswith("exit codes: "):
        return
    yield ".SH EXIT STATUS"
    for code, meaning in re.findall(r"(\d+) (.*?)(?:, (?=\d)|$)", first.removeprefix("exit codes: ")):
        yield f".TP\n.B {code}\n{paragraph(meaning)}"
    if rest:
        yield ".PP\n" + paragraph(" ".join(rest.split()))


def listed(title, table):
    if table:
        yield ".SH " + title
        for name, text in table.items():
            yield f".TP\n{bold(name)}\n{paragraph(text)}"


def examples(notes):
    if notes.get("examples"):
        yield ".SH EXAMPLES"
        for number, (command, text) in enumerate(notes["examples"].items()):
            if number:
                yield ".PP"
            yield paragraph(text)
            yield ".PP\n.nf\n.RS\n" + escape(command) + "\n.RE\n.fi"


def see_also(pages):
    yield ".SH SEE ALSO"
    references = [f"\\fB{escape(name)}\\fR({section})" for name, section in (page.rsplit(".", 1) for page in pages)]
    yield ",\n".join(references)


def page(words, definition, notes, edition, also):
    """The page of the command `words`; `notes` is what no definition says of it, `also` other pages.

    `edition` is the version of the tools and the date of the notes.
    """
    version, date = edition
    name = "-".join(words)
    brief = notes.get("brief") or definition["description"].split(". ")[0].rstrip(".")
    parts = [f'.TH {escape(name).upper()} 1 "{date}" "Vorion {version}" "Vorion"', ".ad l", ".nh", ".SH NAME",
             f"{escape(name)} \\- {escape(brief[0].lower() + brief[1:])}", ".SH SYNOPSIS"]
    if definition.get("usage"):
        first, _, rest = definition["usage"].partition(" ")
        parts.append(bold(first) + " " + escape(rest))
    else:
        parts.append(synopsis(words, definition))
    parts.append(".SH DESCRIPTION")
    parts.append(paragraph(notes.get("description") or definition["description"].rstrip(".") + "."))
    if "commands" in definition:
        parts.append(".SH COMMANDS\nEach has a page of its own.")
        for command in definition["commands"]:
            parts.append(f".TP\n{bold(command['name'])}\n{paragraph(command['description'] + '.')}")
    parts += entries(definition["options"])
    if definition.get("others"):
        parts.append(".SH OTHER OPTIONS" if definition["options"] else ".SH OPTIONS")
        parts.append(paragraph(f"There are {len(definition['others'])} options of LLVM's, which --help lists."))
    parts += exit_status(definition["footer"])
    parts += listed("ENVIRONMENT", notes.get("environment"))
    files = dict(notes.get("files", {}))
    if any("docs/" in part for part in parts):
        files["/usr/share/doc/vorion/docs/"] = "What this page calls docs/, where Debian's package vorion-doc is installed."
    parts += listed("FILES", files)
    parts += examples(notes)
    parts += see_also(also)
    return "\n".join(parts) + "\n"
