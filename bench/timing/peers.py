"""Programs outside of the project that run another machine or model, and print its figures in the form of the references."""

import json
import subprocess
import sys


def add(parser):
    parser.add_argument("--peer", metavar="PROGRAM", help="its figures take the place of the references'")


def figures(program, form, *arguments):
    """What the program prints when it is called with the arguments; ends the script with one line if that is not of a form, list
    or dict, in JSON."""
    me = sys.argv[0].rsplit("/", 1)[-1]
    try:
        done = subprocess.run([program, *arguments], stdout=subprocess.PIPE, text=True)
        if done.returncode != 0:
            sys.exit(f"{me}: error: {program}: exit code {done.returncode}, expected 0")
        found = json.loads(done.stdout)
    except OSError as error:
        sys.exit(f"{me}: error: {program}: {error.strerror}, expected a program")
    except ValueError as error:
        sys.exit(f"{me}: error: {program}: its output is no JSON ({error}), expected references")
    if not isinstance(found, form):
        sys.exit(f"{me}: error: {program}: printed no {'list' if form is list else 'object'}, expected references")
    return found
