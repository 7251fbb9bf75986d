#!/usr/bin/env python3
"""Finds what hand-written files repeat of the records of intrinsics/.

usage: literals.py ROOT
A line each: a literal of a CSR's number, a list of the counters, a list of a lane unit's choices.
Exit codes: 0 nothing found, 1 something.
"""

import os
import re
import sys

ROOT = sys.argv[1]
sys.path.insert(0, os.path.join(ROOT, "intrinsics", "generate"))
from records import Records  # noqa: E402

FOLDERS = ("apps", "bench", "isasim", "libdevice", "llvm-backend", "reference", "runtime", "support", "test")
SOURCES = (".S", ".c", ".cl", ".cpp", ".def", ".h", ".inc", ".js", ".py", ".td")
# Numbers below are too common, and so is a mask.
LEAST_CSR = 0x300
NUMBER = re.compile(r"(?<!& )\b0x([0-9a-f]{3})U?\b", re.I)


def sources():
    """(path, text) of what is written by hand."""
    for folder in FOLDERS:
        for place, folders, files in os.walk(os.path.join(ROOT, folder)):
            folders.sort()
            for file in sorted(files):
                path = os.path.join(place, file)
                if file.endswith(SOURCES) and os.path.abspath(path) != os.path.abspath(__file__):
                    with open(path, encoding="utf-8", errors="replace") as opened:
                        yield os.path.relpath(path, ROOT), opened.read()


def is_test(path):
    return path.startswith("test" + os.sep) or re.search(r"_test\.(c|cpp)$", path) is not None


def literals(csrs, path, text):
    for number, line in enumerate(text.splitlines(), 1):
        # Tests have numbers of all kinds.
        if is_test(path) and "csr" not in line.lower():
            continue
        for found in NUMBER.finditer(line):
            value = int(found[1], 16)
            if value >= LEAST_CSR and value in csrs:
                yield f"{path}:{number}: {found[0]} is the number of {csrs[value]}, expected its name"


def lists(kind, names, spelling, path, text):
    """A file that has more than half of the names carries them; tests look for them one by one, as they should."""
    found = [name for name in names if re.search(spelling(name), text)]
    if not is_test(path) and len(found) > len(names) / 2:
        yield f"{path}: a list of the {kind}, expected the generated one: {', '.join(found)}"


def main():
    records = Records()
    csrs = {c.Number: c.Name for c in records.of("Csr")}
    counters = [c.Counter for c in records.of("RasterCounter")]
    repeated = []
    for path, text in sources():
        repeated += literals(csrs, path, text)
        repeated += lists("rasterizers' counters", counters,
                          lambda n: rf"\b(raster_{n}|vr_n_{n}|VR_N_{n.upper()}|CL_EVENT_RASTER_{n.upper()}_VORION)\b",
                          path, text)
    print("\n".join(repeated) or "nothing is repeated")
    return 1 if repeated else 0


if __name__ == "__main__":
    sys.exit(main())
