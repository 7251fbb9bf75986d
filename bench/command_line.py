"""What the scripts of benchmarks share: options for a program that one runs, and how a script ends."""

import os
import shutil
import sys


def parse(parser):
    """What the parser reads of this script's arguments, and the list of those behind `--`."""
    own = sys.argv[1:]
    if "--" not in own:
        return parser.parse_args(own), []
    at = own.index("--")
    return parser.parse_args(own[:at]), own[at + 1:]


def check_program(parser, command):
    """Ends the script with a usage error if the command names no program that there is."""
    if not command:
        parser.error("no program, expected one with its arguments")
    if not shutil.which(command[0]):
        parser.error(f"{command[0]}: no such program, expected one that uses OpenCL")


def run(main):
    """Ends the script as main() does; quietly where nobody reads on, as under `| head`."""
    try:
        try:
            code = main()
        finally:
            sys.stdout.flush()
    except BrokenPipeError:
        # Else Python, which still has something to write, says so at its end.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        code = 1
    sys.exit(code)
