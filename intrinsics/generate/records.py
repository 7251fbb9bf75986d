"""The records of intrinsics/*.td as plain Python values.

llvm-tblgen --dump-json is the only reader of TableGen; everything that is
derived from the records goes through this module.
"""

import argparse
import json
import os
import subprocess
import sys
from types import SimpleNamespace

FOLDER = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))


class Records:
    """All records, by class, in the order of the files."""

    def __init__(self, tblgen="llvm-tblgen-19"):
        dump = subprocess.run(
            [tblgen, "--dump-json", "-I", FOLDER, os.path.join(FOLDER, "Vorion.td")],
            check=True, stdout=subprocess.PIPE).stdout
        self._dump = json.loads(dump)
        self._require_effects()

    def _require_effects(self):
        """Readers of the records would take an instruction without effects for one of each lane's own operands."""
        for name in self._dump["!instanceof"]["Instruction"]:
            record = self._dump[name]
            if record["Effects"] is None:
                expected = ", ".join(sorted(self._dump["!instanceof"]["EffectClass"]))
                sys.exit(f"{os.path.basename(sys.argv[0])}: error: intrinsics/{record['!locs'][-1]}: {record['Mnemonic']} "
                         f"declares no effects, expected 'let Effects =' one of {expected} (intrinsics/Effects.td)")

    def _resolve(self, value):
        if isinstance(value, dict) and value.get("kind") == "def":
            return self._record(value["def"])
        if isinstance(value, list):
            return [self._resolve(v) for v in value]
        return value

    def _record(self, name):
        raw = self._dump[name]
        fields = {k: self._resolve(v) for k, v in raw.items() if not k.startswith("!")}
        return SimpleNamespace(id=name, file=raw["!locs"][0], **fields)

    def instances(self):
        """The names of all records by class, those of derived classes among them."""
        return self._dump["!instanceof"]

    def of(self, cls):
        """Records of class cls in source order."""
        def place(name):
            file, line = self._dump[name]["!locs"][-1].rsplit(":", 1)
            # Anonymous records of one line keep the order of their numbers.
            digits = "".join(c for c in name if c.isdigit())
            return file, int(line), int(digits or 0)
        names = sorted(self._dump["!instanceof"].get(cls, []), key=place)
        return [self._record(n) for n in names]


def write(path, text):
    """Makes path hold text; a file that does already keeps its time, so that nothing is built again for it."""
    if os.path.exists(path):
        with open(path, encoding="utf-8") as file:
            if file.read() == text:
                return
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)


def write_for_one_of(readers, doc):
    """The main program of a script that writes one file for one of several readers: lines, from all records, by the
    reader's name. The documentation of the script is its help."""
    parser = argparse.ArgumentParser(description=doc, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--tblgen", default="llvm-tblgen-19")
    parser.add_argument("--for", dest="reader", choices=readers, required=True)
    parser.add_argument("output")
    options = parser.parse_args()
    write(options.output, "\n".join(readers[options.reader](Records(options.tblgen))) + "\n")
