#!/usr/bin/env python3
"""Runs a program and demands its exit code: expect_code.py [--room BYTES] CODE COMMAND...
With --room, no file may grow beyond so many bytes, which programs see as an
error of the write: like a full disk."""

import resource
import signal
import subprocess
import sys

arguments = sys.argv[1:]
room = None
if arguments[0] == "--room":
    room = int(arguments[1])
    arguments = arguments[2:]


def limit():
    if room is not None:
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (room, room))


code = subprocess.run(arguments[1:], preexec_fn=limit, restore_signals=False).returncode
if code != int(arguments[0]):
    sys.exit(f"{arguments[1:]} ended with {code}, expected {arguments[0]}")
