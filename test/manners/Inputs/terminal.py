#!/usr/bin/env python3
"""terminal.py FOLDER: what splat writes to standard error on terminals and elsewhere."""

import os
import pty
import re
import subprocess
import sys

KINDS = (("terminal", {"TERM": "xterm"}, True), ("terminal without colour", {"TERM": "xterm", "NO_COLOR": "1"}, True),
         ("dumb terminal", {"TERM": "dumb"}, True), ("terminal of no kind", {}, True), ("pipe", {"TERM": "xterm"}, False))


def said(command, variables, on_terminal):
    """The bytes of standard error; a terminal's own ends of lines are as a program wrote them."""
    reader, writer = pty.openpty() if on_terminal else os.pipe()
    environment = {name: value for name, value in os.environ.items() if name not in ("TERM", "NO_COLOR")} | variables
    child = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=writer, env=environment)
    os.close(writer)
    text = b""
    while True:
        try:
            part = os.read(reader, 4096)
        except OSError:  # how a terminal says that its program has ended
            break
        if not part:
            break
        text += part
    child.wait()
    os.close(reader)
    return text.replace(b"\r\n", b"\n")


def kind(text):
    if b"\r\x1b[K" in text:
        return "overwrites"
    if b"\x1b[1;31m" in text:
        return "colour"
    return "controls" if re.search(rb"[\x00-\x09\x0b-\x1f]", text) else "plain"


folder = sys.argv[1]
capture = os.path.join(folder, "captures", "colmap-binary")
for name, variables, on_terminal in KINDS:
    print("error:", name, kind(said(["splat", "info", os.path.join(folder, "none")], variables, on_terminal)))
for name, variables, on_terminal in KINDS:
    text = said(["splat", "train", capture, "-o", os.path.join(folder, "o.ply"), "--iterations", "51"], variables, on_terminal)
    left = "time left" if re.search(rb"iteration [2-9]\d*/51: [^\n\r]*, \d+ s left", text) else "no time left"
    print(f"training: {name} {kind(text)}, {left}")

render = ["splat", "render", os.path.join(folder, "scene.ply"), "--cameras", os.path.join(folder, "cameras.json"), "--view",
          "front", "--view", "close", "--view", "far", "-o", os.path.join(folder, "view.pfm")]
for name, variables, on_terminal in KINDS:
    text = said(render, variables, on_terminal)
    left = "time left" if re.search(rb"\] view 3 of 3: [^,]*, \d+ (s|min) left", text) else "no time left"
    beyond = ", one too many" if b"view 4 of 3" in text else ""
    print(f"views: {name} {kind(text)}, {left}{beyond}")
print("quiet:", kind(said([*render, "--quiet"], {"TERM": "xterm"}, True)))
