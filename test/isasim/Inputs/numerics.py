"""Prints what the JSON of --numerics says of the lines that make errors."""
import json
import os
import sys

with open(sys.argv[1]) as text:
    report = json.load(text)
assert report["format"] == "vorion-numerics 1"
for line in report["lines"]:
    if line["reach"] or line["nonfin"]:
        print(f"{os.path.basename(line['file'])}:{line['line']} {line['function']} born {line['born']} cancel {line['cancel']}")
