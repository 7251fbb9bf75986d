#!/usr/bin/env python3
"""Takes gradients of a fixture of the private data and compares them with fp64.

usage: gradients.py FIXTURE.npz FOLDER WAY...
A way is raster, simt, or one of the cores' other ways to sum: atomics, warp.
splat-fixture turns the fixture into what splat reads, with its loss left out on
doubtful pixels and the gradients of that. At most 1e-5 relative difference, or
twice the error of the fixture's own fp32 results.
"""

import json
import subprocess
import sys

# A way's options, where they are not those of a path of its name.
SUMS = {way: ["--path", "simt", "--simt-sums", way] for way in ("atomics", "warp")}

fixture, folder, *ways = sys.argv[1:]
subprocess.run(["splat-fixture", fixture, "-o", folder], check=True)
with open(f"{folder}/options.json") as f:
    options = json.load(f)
flags = ["--rules", options["rules"], "--support", options["support"],
         "--dilation", repr(options["dilation"]), "--background", ",".join(map(repr, options["background"]))]
flags += ["--antialiased"] if options["antialiased"] else []
for way in ways:
    subprocess.run(["splat", "gradients", f"{folder}/scene.ply", "--cameras", f"{folder}/cameras.json", "--view", "view",
                    "--upstream", f"{folder}/upstream.npz", *SUMS.get(way, ["--path", way]), "-o", f"{folder}/{way}.npz", *flags],
                   check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["splat-check-gradients", f"{folder}/gradients.npz", f"{folder}/{way}.npz"], check=True)
