#!/usr/bin/env python3
"""counts.py OBJECT SOURCE: whether `vorion-clang --resources` of SOURCE counts the code bytes that OBJECT's symbols have."""

import json
import subprocess
import sys


def said(*command):
    return subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout


target, source = sys.argv[1:]
sizes = {}
for line in said("llvm-nm", "--defined-only", "--print-size", target).splitlines():
    _, size, kind, name = line.split()
    if kind in "tT":
        sizes[name] = int(size, 16)
report = json.loads(said("vorion-clang", "--resources=json", "-O2", "-c", source, "-o", target))
told = {each["function"]: each["code_bytes"] for each in report["functions"]}
print(f"{len(told)} functions, " + ("each as long as its symbol" if told == sizes else f"{told} for {sizes}"))
