"""What clang's opencl-c.h declares."""

import collections
import re

ATTRIBUTE = re.compile(r"__attribute__\s*\(\((?:[^()]|\([^()]*\))*\)\)\s*")
DECLARATION = re.compile(r"^([\w ]+?)\s*\b(\w+)\((.*)\);$")
# What stands before the type that a parameter points to, and the type.
POINTER = re.compile(r"^(.*?)(\w+)(?:\s+(?:const|volatile))?\s*\*")
SKIPPED = re.compile(r"^(typedef|enum|#)|printf")


def declarations(path):
    """Overloads by name: (type of the result, types of the parameters)."""
    found = collections.defaultdict(list)
    with open(path, encoding="utf-8") as file:
        for line in file:
            line = ATTRIBUTE.sub("", line).strip().replace("__", "")
            match = None if SKIPPED.search(line) else DECLARATION.match(line)
            if match:
                result, name, parameters = match.groups()
                found[name].append((result, [] if parameters in ("", "void") else parameters.split(",")))
    return found
