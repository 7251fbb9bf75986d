#!/usr/bin/env python3
"""terminal.py FOLDER: what splat writes to standard error on terminals and elsewhere."""

import fcntl
import os
import pty
import re
import shutil
import signal
import struct
import subprocess
import sys
import termios

KINDS = (("terminal", {"TERM": "xterm"}, True), ("terminal without colour", {"TERM": "xterm", "NO_COLOR": "1"}, True),
         ("dumb terminal", {"TERM": "dumb"}, True), ("terminal of no kind", {}, True), ("pipe", {"TERM": "xterm"}, False))


def said(command, variables, on_terminal, columns=0, until=None, stream="stderr"):
    """The bytes of standard error; a terminal's own ends of lines are as a program wrote them. The program gets an
    interrupt once it has said `until`."""
    reader, writer = pty.openpty() if on_terminal else os.pipe()
    if columns:
        fcntl.ioctl(writer, termios.TIOCSWINSZ, struct.pack("HHHH", 24, columns, 0, 0))
    environment = {name: value for name, value in os.environ.items() if name not in ("TERM", "NO_COLOR", "COLUMNS")} | variables
    streams = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL, stream: writer}
    # A program in the background ignores interrupts, as lit's are.
    child = subprocess.Popen(command, env=environment, preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL), **streams)
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
        if until and until in text:
            child.send_signal(signal.SIGINT)
            until = None
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

# A compiler that takes three seconds to start.
root = os.path.join(folder, "slow")
compiler = shutil.which("vorion-compiler")
os.makedirs(os.path.join(root, "bin"))
for part in ("lib", "include", "pocl"):
    os.symlink(os.path.join(os.path.dirname(os.path.dirname(compiler)), part), os.path.join(root, part))
with open(os.path.join(root, "bin", "vorion-compiler"), "w", encoding="utf-8") as script:
    os.fchmod(script.fileno(), 0o755)
    script.write(f'#!/bin/sh\nsleep 3\nexec {compiler} "$@"\n')
slow = {"TERM": "xterm", "VORION_ROOT": root, "POCL_CACHE_DIR": os.path.join(folder, "slow-cache")}
shown = re.search(rb"splat: compiling (\w+) \.\.\.", said([*render[:7], *render[-2:]], slow, True))
print("compiling for long:", shown.group(1).decode() if shown else "not shown")

# A line is written over in a window of any width, and is the last but for its end.
terminal = {"TERM": "xterm"}


def train(iterations):
    return ["splat", "train", capture, "-o", os.path.join(folder, f"{iterations}.ply"), "--iterations", str(iterations)]


for columns in (20, 80, 200):
    for what, command in (("training", train(columns)), ("views", render)):
        lines = said(command, terminal, True, columns).split(b"\r\x1b[K")
        widest = max(len(line.rstrip(b"\n")) for line in lines)
        whole = all(b"\n" not in line for line in lines[:-1]) and lines[-1].count(b"\n") <= 1
        print(f"{columns} columns: {what}:", "one line" if len(lines) > 9 and widest < columns and whole else lines)
# After an interrupt, the shell's prompt has a line of its own.
long = ["splat", "render", os.path.join(folder, "demo.ply"), "--cameras", os.path.join(folder, "demo.json"), "--path", "simt",
        "-o", os.path.join(folder, "demo.pfm")]
for what, command, until in (("training", train(100000), b"iteration 2/"), ("views", long, b"splat: ")):
    print(f"interrupt: {what}:", said(command, terminal, True, until=until)[-1:])
for columns in (20, 40, 80):
    page = said(["splat", "render", "--help"], terminal, True, columns, stream="stdout").splitlines()
    print(f"help: {columns} columns:", "fits" if max(map(len, page)) <= columns else max(page, key=len))
narrow = said(["splat", "render", "--help"], {"COLUMNS": "30"}, False, stream="stdout").splitlines()
print("help: COLUMNS:", "fits" if max(map(len, narrow)) <= 30 else max(narrow, key=len))
