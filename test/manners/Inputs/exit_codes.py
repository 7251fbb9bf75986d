#!/usr/bin/env python3
"""Prints, as a shell has them, the codes that commands with something wrong, and commands that are interrupted, end with.

usage: exit_codes.py FOLDER
FOLDER has s.ply, c.json, the capture "capture" and the endless program loop.elf.
"""

import os
import signal
import socket
import subprocess
import sys

os.chdir(sys.argv[1])
RENDER = ["splat", "render", "s.ply", "--cameras", "c.json", "-o", "x.png"]


def code_of(status):
    return status if status >= 0 else 128 - status


def wrong(what, command, **variables):
    done = subprocess.run(command, env=os.environ | variables, stdin=subprocess.DEVNULL, capture_output=True, check=False)
    print(f"{what}: {code_of(done.returncode)}: {done.stderr.decode().splitlines()[-1]}")


def interrupted(what, number, command, begun):
    """begun: part of the line that the command prints when it is at work."""
    # Who runs tests in the background may ignore SIGINT, which children inherit.
    signal.signal(number, signal.SIG_DFL)
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True) as process:
        while begun not in (line := process.stdout.readline()):
            if not line:
                sys.exit(f"{what} ended before it printed '{begun}'")
        process.send_signal(number)
        process.communicate()
    print(f"{what}: {code_of(process.returncode)}")


with open("bad.json", "w", encoding="utf-8") as bad:
    bad.write('{"lanes": 4}')
for what, value in ("a key", "foo=1"), ("a value", "clusters=x"), ("a name", "machine=protype"):
    wrong(f"{what} of --set", [*RENDER, "--set", value])
    wrong(f"{what} of VORION_SET", RENDER, VORION_SET=value)
    wrong(f"{what} of vorion-sim", ["vorion-sim", "loop.elf", "--set", value])
wrong("a setting", [*RENDER, "--numerics=foo"])
wrong("a time", RENDER, VORION_TIME="fast")
wrong("a clock", RENDER, VORION_TIME="530000000")
wrong("a checker", RENDER, VORION_CHECK="boundz")
wrong("a view", [*RENDER, "--view", "nosuch"])
wrong("a view to leave out", ["splat", "train", "capture", "-o", "x.ply", "--exclude", "nosuch"])
wrong("a machine", RENDER, VORION_CONFIG="protype")
wrong("a machine of vorion-sim", ["vorion-sim", "loop.elf", "--config", "protype"])
wrong("a machine of no such size", RENDER, VORION_SET="clusters=600")
wrong("a key of the text", RENDER, VORION_CONFIG='{"lanes": 4}')
wrong("a variable of vorion-sim", ["vorion-sim", "loop.elf"], VORION_CONFIG="protype")
wrong("a size of vorion-sim", ["vorion-sim", "loop.elf"], VORION_SET="clusters=600")
with socket.create_server(("127.0.0.1", 0)) as taken:
    wrong("a port", [*RENDER, "--view", "front"], VORION_GDB=str(taken.getsockname()[1]))
wrong("a missing file", RENDER, VORION_CONFIG="./none.json")
wrong("a malformed file", RENDER, VORION_CONFIG="./bad.json")
wrong("a malformed file of vorion-sim", ["vorion-sim", "loop.elf", "--config", "bad.json"])
wrong("a file that cannot be written", RENDER, VORION_TRACE="trap:none/trace")
wrong("a missing compiler", RENDER, VORION_ROOT="/nowhere", POCL_CACHE_DIR="cache")
TRAIN = ["splat", "train", "capture", "-o", "x.ply", "--iterations", "100000"]
interrupted("training, SIGINT", signal.SIGINT, TRAIN, "iteration 1/")
interrupted("training, SIGTERM", signal.SIGTERM, TRAIN, "iteration 1/")
interrupted("a program, SIGINT", signal.SIGINT, ["vorion-sim", "loop.elf", "--global", "1", "--arg", "buf:4", "--trace", "sync"], "sync")
interrupted("the page, SIGINT", signal.SIGINT, ["splat", "view", "s.ply"], "http://")
