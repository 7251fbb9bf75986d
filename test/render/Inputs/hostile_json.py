#!/usr/bin/env python3
"""Gives hostile JSON to everything that reads some and prints how it ends.

usage: hostile_json.py FOLDER
FOLDER has s.ply and c.json. Prints "READER, TEXT: EXIT CODE: MESSAGE", and "N lines" in place of a message that is not one
line.
"""

import os
import subprocess
import sys

folder = sys.argv[1]
DEEP = 200_000
TEXTS = {
    "nested": "[" * DEEP + "]" * DEEP,
    # What looks into a value of any kind, and what writes one into a message, may recurse.
    "nested values": '[{"img_name": "a", "distortion": ' + "[" * DEEP + "]" * DEEP + "}]",
    "nested model": '{"frames": [{"file_path": "a"}], "camera_model": ' + "[" * DEEP + "]" * DEEP + "}",
    "nested objects": '{"a":' * DEEP + "1" + "}" * DEEP,
    "open": "[" * DEEP,
    "keys": "{" + ",".join(f'"k{n}":1' for n in range(60_000)) + "}",
    "number": "[1e999]",
    "second line": '{"a": 1,\n"b": }',
    "empty": "",
    "twice": '{"a": 1,\n"b": {"a": 2}, "\\u0061": 3}',
}


def write(name, text):
    os.makedirs(os.path.dirname(f"{folder}/{name}"), exist_ok=True)
    with open(f"{folder}/{name}", "w") as f:
        f.write(text)


def attempt(what, *command):
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=60)
    lines = done.stderr.splitlines()
    print(f"{what}: {done.returncode}: {lines[0] if len(lines) == 1 else f'{len(lines)} lines'}")


for kind, text in TEXTS.items():
    for name in ("cameras.json", "config.json", "capture/transforms.json", "sog/meta.json", "lod/lod-meta.json"):
        write(name, text)
    attempt(f"cameras, {kind}", "splat", "render", "s.ply", "--cameras", "cameras.json", "--view", "front", "-o", "p.png")
    attempt(f"capture, {kind}", "splat", "info", "capture")
    attempt(f"sog, {kind}", "splat", "info", "sog")
    attempt(f"streamed sog, {kind}", "splat", "info", "lod")
    attempt(f"configuration, {kind}", "vorion-sim", "--config", "config.json", "--print-default-config")
    attempt(f"launch, {kind}", "vorion-sim", "none.elf", "--args", "config.json")
