"""usage: variables.py FOLDER PAGE: checks that PAGE has a row for each variable of FOLDER's Variables.def, and for each of
SessionOptions.def, with the option that does the same."""

import re
import sys

folder, page = sys.argv[1:]


def records(name, pattern):
    with open(f"{folder}/{name}", encoding="utf-8") as file:
        found = re.findall(pattern, file.read())
    assert found, name
    return found


with open(page, encoding="utf-8") as file:
    rows = [[cell.strip() for cell in line.split("|")[1:-1]] for line in file if line.startswith("|")]
for name, effect, readers in records("Variables.def", r'VORION_VARIABLE\("(\w+)",\s*"([^"]*)",\s*"([^"]*)"'):
    if [f"`{name}`", effect, readers] not in rows:
        sys.exit(f"{page} has no row: | `{name}` | {effect} | {readers} |")
for option, name in records("SessionOptions.def", r'VORION_SESSION_OPTION\(\w+, "([\w-]+)", "(\w+)"'):
    if not any(row[0].startswith(f"`{option}") and row[1] == f"`{name}`" for row in rows):
        sys.exit(f"{page} has no row: | `{option}` | `{name}` |")
