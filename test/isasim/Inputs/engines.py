"""Runs programs of bench/isasim with each engine, in long turns and in short ones: what they print and count, and where
cores meet, must be the same. So does one-hart.c, with one hart. usage: engines.py FOLDER PROGRAM..."""

import json
import os
import subprocess
import sys

BENCH = os.path.join(os.path.dirname(__file__), "..", "..", "..", "bench", "isasim")

ENGINES = ("interpreter", "translator", "translator-avx2")


def outcome(program, stats, turn, engine, *options):
    command = ["vorion-sim", program, *options, "--set", f"quantum={turn},engine={engine}", "--stats", stats]
    text = subprocess.run(command, check=True, capture_output=True, text=True).stdout.splitlines()[0]
    with open(stats, encoding="utf-8") as file:
        run = json.load(file)["runs"][0]
    return text, {key: value for key, value in run.items() if not key.startswith("host_")}


def compare(name, sources, *options):
    elf = os.path.join(folder, name + ".elf")
    subprocess.run(["vorion-clang", "-O3", "-DREPEATS=1", *sources, "-o", elf], check=True)
    for turn in (100, 1 << 16):
        expected, *others = (outcome(elf, os.path.join(folder, "stats.json"), turn, engine, *options) for engine in ENGINES)
        for engine, other in zip(ENGINES[1:], others):
            if other != expected:
                sys.exit(f"{name}, turns of {turn}: the interpreter gives {expected}, {engine} {other}")
    print(f"{name}: the same")


folder, *names = sys.argv[1:]
for each in names:
    compare(each, [os.path.join(BENCH, file + ".c") for file in (each, "device")])
compare("one-hart", [os.path.join(os.path.dirname(__file__), "one-hart.c")], "--one-hart")
