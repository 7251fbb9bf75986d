#!/usr/bin/env python3
"""Takes gradients of a fixture of the private data and compares them with fp64.

usage: gradients.py FIXTURE.npz FOLDER PATH...
splat-fixture turns the fixture into what splat reads, with its loss left out on
doubtful pixels and the gradients of that. At most 1e-5 relative difference, or
twice the error of the fixture's own fp32 results.
"""

import json
import subprocess
import sys

fixture, folder, *paths = sys.argv[1:]
subprocess.run(["splat-fixture", fixture, "-o", folder], check=True)
with open(f"{folder}/options.json") as f:
    options = json.load(f)
flags = ["--rules", options["rules"], "--support", options["support"],
         "--dilation", repr(options["dilation"]), "--background", ",".join(map(repr, options["background"]))]
flags += ["--antialiased"] if options["antialiased"] else []
for path in paths:
    subprocess.run(["splat", "gradients", f"{folder}/scene.ply", "--cameras", f"{folder}/cameras.json", "--view", "view",
                    "--upstream", f"{folder}/upstream.npz", "--path", path, "-o", f"{folder}/{path}.npz", *flags],
                   check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["splat-check-gradients", f"{folder}/gradients.npz", f"{folder}/{path}.npz"], check=True)
