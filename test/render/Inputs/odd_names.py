#!/usr/bin/env python3
"""Files whose names, inside and outside, hold what a terminal obeys; prints what splat writes about them, as Python shows it.

usage: odd_names.py FOLDER
FOLDER has s.ply and c.json.
"""

import json
import os
import subprocess
import sys

folder = os.fsencode(sys.argv[1])
ODD = "a\x1b[31mb\nsplat: error: c\u202e\u009b"


def attempt(what, *arguments):
    done = subprocess.run(["splat", *arguments], cwd=folder, capture_output=True)
    for stream, text in (("out", done.stdout), ("err", done.stderr)):
        obeyed = [b for b in (b"\x1b", b"\xc2\x9b", b"\xe2\x80\xae", b"\xff") if b in text]
        lines = text.count(b"\nsplat: error: c")
        print(f"{what}, {stream}: {obeyed}, {lines} lines of others")
    print(f"{what}: {done.returncode}: {done.stderr.decode(errors='replace').strip()}")


with open(os.path.join(folder, b"c.json")) as f:
    views = json.load(f)
views[0]["img_name"] = ODD
with open(os.path.join(folder, b"odd.json"), "w") as f:
    json.dump(views, f)
attempt("view", "analyze", "s.ply", "--cameras", "odd.json", "--view", "back")
attempt("view in a report", "analyze", "s.ply", "--cameras", "odd.json", "--view", ODD)
del views[0]["fx"]
with open(os.path.join(folder, b"odd.json"), "w") as f:
    json.dump(views, f)
attempt("view without a key", "analyze", "s.ply", "--cameras", "odd.json", "--view", "0")
with open(os.path.join(folder, b"s.ply"), "rb") as f:
    scene = f.read()
with open(os.path.join(folder, b"p.ply"), "wb") as f:
    f.write(scene.replace(b"property float opacity\n", b"property float opa\x1b[31mcity\n"))
attempt("property", "info", "p.ply")
path = "s\udcff\x1b.ply"
with open(os.path.join(folder, os.fsencode(path)), "wb") as f:
    f.write(scene)
attempt("path", "info", path)
attempt("path in JSON", "info", path, "--json", "odd-path.json")
with open(os.path.join(folder, b"odd-path.json"), "rb") as f:
    print("path in JSON:", json.loads(f.read().decode())["scene"]["file"].encode("unicode_escape"))
attempt("missing path", "info", path + "x")
attempt("option", "info", "s.ply", "--\x1b[31m")
attempt("subcommand", "inf\x1b")
