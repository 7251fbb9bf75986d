#!/usr/bin/env python3
"""What each observer costs while it is on: host instructions by callgrind, as a ratio to the plain run.

usage: bench/observers.py [--build BUILD] [--without BUILD] [--only NAME,...] [--json FILE]

Runs one kernel (an fp32 matrix product of 64 x 64 with local memory and barriers) on vorion-sim with
each observer. Instructions, since they do not depend on what else the machine does. Traces and
profiles go to files below BUILD/observers. --without names a build with VORION_OBSERVERS=OFF, in
which none of it is built in, to be compared with the run in which all of it is off. Exit codes: 0,
1 a run failed.
"""

import argparse
import json
import os
import re
import subprocess
import sys

import command_line

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
KERNEL = """
kernel void multiply(global const float *a, global const float *b, global float *c) {
  local float ta[16][16], tb[16][16];
  uint x = get_local_id(0), y = get_local_id(1), n = get_global_size(0);
  uint column = get_global_id(0), row = get_global_id(1);
  float sum = 0;
  for (uint k = 0; k < n; k += 16) {
    ta[y][x] = a[row * n + k + x];
    tb[y][x] = b[(k + y) * n + column];
    barrier(CLK_LOCAL_MEM_FENCE);
    for (uint m = 0; m < 16; ++m)
      sum += ta[y][m] * tb[m][x];
    barrier(CLK_LOCAL_MEM_FENCE);
  }
  c[row * n + column] = sum;
}
"""
OBSERVERS = [
    ("none", []),
    ("--stats", ["--stats", "stats.json"]),
    ("--timeline", ["--timeline", "timeline.json"]),
    ("--profile", ["--profile=profile.txt"]),
    ("--trace sync,raster,trap", ["--trace", "sync,raster,trap:trace.txt"]),
    ("--trace mem", ["--trace", "mem:trace.txt"]),
    ("--trace insn", ["--trace", "insn:trace.txt"]),
    ("--numerics", ["--numerics=text=numerics.txt"]),
    ("--time", ["--time"]),
    ("--time --timeline", ["--time", "--timeline", "cycles.json"]),
    ("--time --profile", ["--time", "--profile=cycles.txt"]),
    ("--tiles", ["--tiles", "tiles.txt"]),
    ("--dram-trace", ["--dram-trace", "dram"]),
    ("--pipeline", ["--pipeline", "file=pipeline.txt"]),
]


def checks(simulator):
    """The observers that --check offers, by its help."""
    text = subprocess.run([simulator, "--help"], check=True, capture_output=True, text=True).stdout
    names = re.search(r"^ *--check .*: (.*)$", text, re.M).group(1).split(", ")
    return [(f"--check {name}", ["--check", name]) for name in names]


def instructions(folder, command):
    """Host instructions of the command, all threads."""
    run = subprocess.run(["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null"] + command,
                         cwd=folder, capture_output=True, text=True)
    found = re.search(r"Collected : (\d+)", run.stderr)
    if run.returncode != 0 or not found:
        sys.exit(f"observers.py: error: {' '.join(command)} failed: {run.stderr[-500:]}")
    return int(found.group(1))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", default=os.path.join(ROOT, "build", "dev"))
    parser.add_argument("--without", help="a build with VORION_OBSERVERS=OFF")
    parser.add_argument("--only", help="observers to measure, by name (default: all)")
    parser.add_argument("--json")
    options = parser.parse_args()
    folder = os.path.join(options.build, "observers")
    os.makedirs(folder, exist_ok=True)
    tools = os.path.join(os.path.abspath(options.build), "bin")
    with open(os.path.join(folder, "multiply.cl"), "w") as source:
        source.write(KERNEL)
    subprocess.run([os.path.join(tools, "vorion-clang"), "-g", "multiply.cl", "-o", "multiply.elf"], cwd=folder, check=True)
    # Valgrind 3.19 cannot read clang's debug information.
    builds = [("vorion-sim", tools)]
    if options.without:
        builds.append(("vorion-sim-without", os.path.join(os.path.abspath(options.without), "bin")))
    for name, folder_of in builds:
        subprocess.run(["strip", "-o", name, os.path.join(folder_of, "vorion-sim")], cwd=folder, check=True)
    run = ["--global", "64,64", "--local", "16,16", "--arg", "buf:16384", "--arg", "buf:16384", "--arg", "out:16384@c.bin"]
    observers = OBSERVERS + checks(os.path.join(folder, "vorion-sim"))
    wanted = [o for o in observers if not options.only or o[0] == "none" or o[0] in options.only.split(",")]
    if options.without:
        wanted.insert(1, ("not built in", []))
    rows = []
    for name, extra in wanted:
        simulator = [f"./{builds[name == 'not built in'][0]}", "multiply.elf", "--set", "host_threads=1"]
        # What the run itself costs, without reading the program and making the machine.
        start = instructions(folder, simulator + ["--list-kernels"])
        count = instructions(folder, simulator + run + extra) - start
        rows.append({"observer": name, "instructions": count, "ratio": count / (rows[0]["instructions"] if rows else count)})
        print(f"{name:<26}{count / 1e6:>12.1f} M{rows[-1]['ratio']:>10.4g}x", flush=True)
    if options.json:
        with open(options.json, "w") as out:
            json.dump(rows, out, indent=1)


if __name__ == "__main__":
    command_line.run(main)
