#!/usr/bin/env python3
"""Renders a fixture of the private data and compares it with its own fp64 result.

usage: fixture.py FIXTURE.npz FOLDER PATH...
splat-fixture turns the fixture into what splat reads; the masks of doubtful
pixels are the fixture's where it has them, and the reference's: at most 0.5 %
of the picture, 2 % of a hard case.
"""

import json
import os
import subprocess
import sys

fixture, folder, *paths = sys.argv[1:]
subprocess.run(["splat-fixture", fixture, "-o", folder], check=True)
with open(f"{folder}/options.json") as f:
    options = json.load(f)
doubtful = "2" if os.path.basename(fixture).startswith("hard_") else "0.5"
flags = ["--rules", options["rules"], "--support", options["support"],
         "--dilation", repr(options["dilation"]), "--background", ",".join(map(repr, options["background"]))]
flags += ["--antialiased"] if options["antialiased"] else []
for path in paths:
    subprocess.run(["splat", "render", f"{folder}/scene.ply", "--cameras", f"{folder}/cameras.json", "--view", "view",
                    "--path", path, "-o", f"{folder}/{path}.npz", *flags], check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["splat", "compare", f"{folder}/expected.npz", f"{folder}/{path}.npz", "--mask",
                    f"{folder}/reference.npz", "--min-db", "90", "--max-doubtful", doubtful], check=True)
