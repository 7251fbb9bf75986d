"""What completion in all shells has in common."""

import re

# The command that every tool with commands has, and no definition names.
HELP, HELP_BRIEF = "help", "Prints the help of a command"


def is_plain(name):
    """Whether an option's name is a word that no shell takes apart."""
    return re.fullmatch(r"--?[A-Za-z0-9][\w.+-]*", name) is not None


def options_in(tool, command):
    """The options that may follow a command: its own, and its tool's, unless these end it."""
    own = {name for option in command["options"] for name in option["names"]}
    return command["options"] + [o for o in tool["options"] if "position" not in o and "--version" not in o["names"]
                                 and not own.intersection(o["names"])]


def brief(option, most=120):
    """The first sentence of an option's help."""
    text = " ".join(option["help"].split())
    text = re.split(r"(?<=[^.])[.;:] |\s\(", text, maxsplit=1)[0].rstrip(".:")
    return text if len(text) <= most else text[:most - 3].rsplit(" ", 1)[0] + " ..."
