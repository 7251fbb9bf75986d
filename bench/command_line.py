"""Command lines of benchmarks that run a program with options of its own."""

import sys


def parse(parser):
    """What the parser reads of this script's arguments, and the list of those behind `--`."""
    own = sys.argv[1:]
    if "--" not in own:
        return parser.parse_args(own), []
    at = own.index("--")
    return parser.parse_args(own[:at]), own[at + 1:]
