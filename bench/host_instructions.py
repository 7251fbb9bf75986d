#!/usr/bin/env python3
"""Host instructions of two builds, by callgrind: whether a change made the simulator dearer, on any busy computer.

usage: bench/host_instructions.py [--out FOLDER] [--json FILE] [--at-most PERCENT] BEFORE AFTER

BEFORE and AFTER are build folders, or what `cmake --install` made of them. Runs the C programs of bench/isasim once on
one core of vorion-sim, and draws a small frame of the demo scene with splat, without and with the clock. Both builds
run the same ELF files and the same scene, made with AFTER; of a frame each compiles its own kernels, before it is
counted. Prints a table. Exit codes: 0 done, 1 AFTER takes more than PERCENT more (default 0.1) of one or a run failed,
2 usage.
"""

import argparse
import glob
import json
import os
import re
import shutil
import subprocess
import sys

import command_line

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
PROGRAMS = ("integer", "matmul", "radixsort", "search", "histogram")
ONE_CORE = {"clusters": 1, "sockets_per_cluster": 1, "cores_per_socket": 1}
FRAME = ["render", "scene.ply", "--cameras", "cameras.json", "--view", "front", "-o", "out.png"]


def call(command, folder, environment=None):
    run = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True)
    if run.returncode != 0:
        sys.exit(f"host_instructions.py: error: {' '.join(command)} failed: {run.stderr[-500:]}")
    return run.stderr


class Build:
    """A build, and what it loads without line tables, some of which valgrind cannot read."""

    def __init__(self, folder, out, name):
        self.folder, self.out = os.path.abspath(folder), out
        self.bin = os.path.join(out, name, "bin")
        os.makedirs(self.bin)
        # libvorion-pocl.so finds its files beside its own folder.
        os.symlink(os.path.join(self.folder, "pocl", "share"), os.path.join(out, name, "share"))
        for program in ("splat", "vorion-sim"):
            if not os.path.exists(os.path.join(self.folder, "bin", program)):
                sys.exit(f"host_instructions.py: error: {folder}: has no bin/{program}, expected a build folder or an "
                         "installed Vorion")
        libraries = [path for part in ("lib", "pocl/lib")
                     for path in glob.glob(os.path.join(self.folder, part, "lib*.so*"))]
        for path in [os.path.join(self.folder, "bin", program) for program in ("splat", "vorion-sim")] + libraries:
            call(["llvm-strip-19", "-g", path, "-o", os.path.join(self.bin, os.path.basename(path))], out)
        self.environment = os.environ | {
            "VORION_ROOT": self.folder, "OCL_ICD_VENDORS": os.path.join(self.bin, "libvorion-pocl.so"),
            "LD_LIBRARY_PATH": self.bin, "POCL_CACHE_DIR": os.path.join(out, f"cache-{name}")}

    def tool(self, *command):
        return call([os.path.join(self.folder, "bin", command[0]), *command[1:]], self.out, self.environment)

    def counted(self, program, *arguments):
        """Instructions of all threads."""
        log = call(["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", os.path.join(self.bin, program),
                    *arguments], self.out, self.environment)
        return int(re.search(r"Collected : (\d+)", log).group(1))


def measured(builds, out):
    """(name, instructions by build) of everything, one after the other."""
    with open(os.path.join(out, "one-core.json"), "w", encoding="utf-8") as file:
        json.dump(ONE_CORE, file)
    source = os.path.join(ROOT, "bench", "isasim")
    for name in PROGRAMS:
        builds[-1].tool("vorion-clang", "-O3", "-DREPEATS=1", os.path.join(source, name + ".c"),
                        os.path.join(source, "device.c"), "-o", name + ".elf")
        yield name, [b.counted("vorion-sim", name + ".elf", "--set", "host_threads=1", "--config", "one-core.json")
                     for b in builds]
    builds[-1].tool("splat", "demo-scene", "-o", "scene.ply", "--cameras", "cameras.json", "--gaussians", "4000")
    for name, options in (("frame", []), ("frame with the clock", ["--time"])):
        for build in builds:
            build.tool("splat", *FRAME, *options)
        yield name, [b.counted("splat", *FRAME, *options) for b in builds]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", default=os.path.join(ROOT, "build", "host-instructions"))
    parser.add_argument("--json")
    parser.add_argument("--at-most", type=float, default=0.1, metavar="PERCENT")
    parser.add_argument("before")
    parser.add_argument("after")
    options = parser.parse_args()
    out = os.path.abspath(options.out)
    shutil.rmtree(out, ignore_errors=True)
    os.makedirs(out)
    builds = [Build(options.before, out, "before"), Build(options.after, out, "after")]
    print("| program | before | after | more |\n|---|--:|--:|--:|")
    rows = []
    for name, (before, after) in measured(builds, out):
        rows.append({"program": name, "before": before, "after": after, "percent_more": 100 * (after / before - 1)})
        print(f"| {name} | {before / 1e6:.2f} M | {after / 1e6:.2f} M | {rows[-1]['percent_more']:+.2f} % |", flush=True)
    if options.json:
        with open(options.json, "w", encoding="utf-8") as file:
            json.dump(rows, file, indent=1)
    return int(any(row["percent_more"] > options.at_most for row in rows))


if __name__ == "__main__":
    command_line.run(main)
