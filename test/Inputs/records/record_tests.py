#!/usr/bin/env python3
"""Writes the input of a lit test for every record of intrinsics/*.td.

usage: record_tests.py KIND ROOT      prints the input of one kind (kinds.py lists them)
       record_tests.py coverage ROOT  checks that every record is in the input of each kind that applies to it,
                                      and that a test of ROOT/test runs each kind; prints the counts
ROOT is the repository, or a folder with an intrinsics/ and a test/ like its own.
Exit codes: 0 done, 1 a record is not covered, 2 usage.
"""

import os
import re
import sys

if len(sys.argv) != 3:
    print(__doc__, file=sys.stderr)
    sys.exit(2)
ROOT = sys.argv[2]
sys.path.insert(0, os.path.join(ROOT, "intrinsics", "generate"))
from kinds import KINDS, kinds_for  # pylint: disable=wrong-import-position
from records import Records  # pylint: disable=wrong-import-position

# Instructions, CSRs and intrinsics; the other records are layouts and numbers.
CLASSES = ("Instruction", "Csr", "CompilerIntrinsic")


def classes_of(records, name):
    return {cls for cls, names in records.instances().items() if name in names}


def run_lines():
    """The RUN lines of all tests."""
    for folder, _, files in os.walk(os.path.join(ROOT, "test")):
        for file in files:
            if file.endswith(".test"):
                with open(os.path.join(folder, file), encoding="utf-8") as text:
                    yield from (line for line in text if line.startswith("RUN:"))


def coverage(records):
    wrong = []
    runs = "".join(run_lines())
    for kind, generate in KINDS.items():
        if not re.search(rf"record_tests\.py {kind} ", runs):
            wrong.append(f"no test runs record_tests.py {kind}")
        covered = {name for name, lines in generate(records) if any("CHECK" in line for line in lines)
                   or name is not None and kind == "builtin-extension"}
        wanted = {r.id for cls in CLASSES for r in records.of(cls) if kind in kinds_for(classes_of(records, r.id), r)}
        wrong += [f"{kind}: nothing for {name}" for name in sorted(wanted - covered)]
        wrong += [f"{kind}: {name} should not be there" for name in sorted(covered - wanted - {None})]
        print(f"{kind}: {len(wanted)} records")
    for line in wrong:
        print(f"record_tests.py: error: {line}", file=sys.stderr)
    return 1 if wrong else 0


def main():
    records = Records()
    if sys.argv[1] == "coverage":
        return coverage(records)
    if sys.argv[1] not in KINDS:
        print(f"record_tests.py: error: no kind '{sys.argv[1]}', expected one of: {' '.join(KINDS)}", file=sys.stderr)
        return 2
    for name, lines in KINDS[sys.argv[1]](records):
        comment = ";" if sys.argv[1] == "codegen" else "//" if sys.argv[1].startswith("builtin") else "#"
        if name:
            print(f"{comment} record {name}")
        print("\n".join(lines))
    return 0


if __name__ == "__main__":
    sys.exit(main())
