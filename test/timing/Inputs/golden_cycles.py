#!/usr/bin/env python3
"""Compares the cycles of small runs with those that are kept beside this file.

usage: golden_cycles.py [--update] BUILD FOLDER

A run is a loop of a few instructions on one core, on several cores or on a machine of other numbers, or a
frame of a small scene. Programs are made in FOLDER. The kept file, cycles.json, names the version of the clock
that it belongs to. Cycles that differ are an error: raise ClockVersion (isasim/include/vorion/isasim/Timing.h), say in
docs/model.md under "Versions of the clock" what changed and why, and run with --update. The frames' kernels are compiled.
If only frames differ, because the compiler makes other code of them or memory lies elsewhere, the version stays: run with
--update alone.

exit codes: 0 all as kept (or written), 1 a run differs or failed, 2 usage
"""

import argparse
import json
import os
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
KEPT = os.path.join(HERE, "cycles.json")
ASSEMBLE = os.path.join(HERE, "..", "..", "isasim", "Inputs", "assemble.sh")
SCENE = os.path.join(HERE, "..", "..", "render", "Inputs", "scene.py")

START = """
  .globl _start
_start:
  li t0, -1
  srli t0, t0, 16
  vx_tmc t0
  li t0, -1               # in the new lanes, too
  srli t0, t0, 16
  csrr s0, vx_thread_id
  csrr s1, vx_core_id
  slli s2, s1, 17
  la s3, buffer
  add s3, s3, s2          # 128 KiB of global memory a core
  sh2add s4, s0, s3       # a word a lane, in one line
  slli s5, s0, 6
  add s5, s5, s3          # a line a lane
  li s6, 0xffff0000
  sh2add s7, s0, s6       # a word a lane in local memory
  slli s8, s0, 6
  add s8, s8, s6          # 16 lanes in one bank
  sw s3, 0(s4)
  fcvt.s.w fs0, s0
  li s9, COUNT
1:
"""
END = """
  addi s9, s9, -1
  bnez s9, 1b
  li a0, 0
  vx_tmc a0
  .bss
  .balign 4096
buffer:
  .zero 1 << 20
"""


def times(count, *lines):
    """The lines again and again; {} is the number of the repetition."""
    return "\n".join("  " + line.format(n) for n in range(count) for line in lines)


# Name: (body of the loop, rounds).
LOOPS = {
    "add_independent": (times(2, *(f"addi a{n}, a{n}, 1" for n in range(8))), 40),
    "add_dependent": (times(16, "addi a0, a0, 1"), 40),
    "mul_dependent": (times(8, "mul a0, a0, a1"), 40),
    "mul_independent": (times(4, "mul a0, a4, a5", "mul a1, a4, a5", "mul a2, a4, a5", "mul a3, a4, a5"), 40),
    "div": (times(4, "divu a0, a4, a5", "divu a1, a4, a5"), 20),
    "fma_dependent": (times(8, "fmadd.s fa0, fa0, fs0, fs0"), 40),
    "fma_independent": (times(4, *(f"fmadd.s fa{n}, fa4, fs0, fs0" for n in range(4))), 40),
    "fdiv": (times(4, "fdiv.s fa0, fs0, fs0", "fdiv.s fa1, fs0, fs0"), 20),
    "fsqrt": (times(4, "fsqrt.s fa0, fs0", "fsqrt.s fa1, fs0"), 20),
    "fcvt": (times(8, "fcvt.w.s a0, fs0", "fcvt.s.w fa0, a0"), 20),
    "mixed_units": (times(4, "mul a0, a1, a2", "fadd.s fa0, fs0, fs0", "add a3, a0, a0", "fcvt.w.s a4, fa0"), 40),
    "branch_taken": (times(8, "j 2f", "2:"), 40),
    "branch_not_taken": (times(8, "bnez x0, 1b"), 40),
    "split_join": ("  slti a0, s0, 8\n" + times(4, "vx_split a1, a0", "beqz a0, 2f", "addi a2, a2, 1", "2:", "vx_join a1"), 20),
    "nested_splits": ("  slti a0, s0, 8\n  slti a3, s0, 4\n" + times(
        2, "vx_split a1, a0", "beqz a0, 2f", "vx_split a4, a3", "beqz a3, 3f", "addi a2, a2, 1", "3:", "vx_join a4", "2:", "vx_join a1"), 20),
    "mask": (times(8, "vx_tmc t0"), 40),
    "barrier": ("  li a0, 0\n  li a1, 1\n" + times(8, "vx_bar a0, a1"), 20),
    "load_independent": (times(4, *(f"lw a{n}, 0(s4)" for n in range(4))), 40),
    "load_dependent": (times(8, "lw a0, 0(s4)", "andi a0, a0, 0", "add s4, s4, a0"), 20),
    "load_16_lines": (times(4, "lw a0, 0(s5)", "lw a1, 0(s5)"), 20),
    "store": (times(8, "sw a0, 0(s4)"), 40),
    "store_then_load": (times(8, "sw a0, 0(s4)", "lw a1, 0(s4)"), 20),
    "store_16_lines": (times(4, "sw a0, 0(s5)"), 20),
    "atomic": (times(4, "amoadd.w a0, s0, (s4)"), 20),
    "fence": (times(4, "sw a0, 0(s4)", "fence"), 20),
    "local_load": (times(8, "lw a0, 0(s7)", "add a1, a0, a0"), 20),
    "local_conflict": (times(4, "lw a0, 0(s8)"), 20),
    "local_store": (times(8, "sw a0, 0(s7)"), 40),
    "stream": ("  lw a0, 0(s4)\n  addi s4, s4, 64\n", 800),
    "stream_of_stores": ("  sw s9, 0(s4)\n  addi s4, s4, 64\n", 800),
    "rows": ("  lw a0, 0(s4)\n  li a1, 1 << 14\n  add s4, s4, a1\n  li a2, (1 << 17) - 1\n  sub a3, s4, s3\n"
             "  and a3, a3, a2\n  add s4, s3, a3\n  addi s4, s4, 192\n", 300),
    "random": ("  li a1, 1103515245\n  mul a0, a0, a1\n  addi a0, a0, 1237\n  srli a2, a0, 10\n  li a3, (1 << 17) - 64\n"
               "  and a2, a2, a3\n  add a2, a2, s3\n  lw a4, 0(a2)\n", 400),
}
CORES = ["add_independent", "add_dependent", "mul_dependent", "fma_dependent", "fma_independent", "mixed_units", "branch_taken",
         "split_join", "nested_splits", "local_conflict", "load_independent"]
PLAIN = "machine=prototype-on-chip"
ONE = [PLAIN, "sockets_per_cluster=1", "cores_per_socket=1"]


def runs():
    """(name, loop, settings)."""
    for loop in LOOPS:
        yield loop, loop, ONE
    for preset in ("vortex-5stage", "vortex-2025"):
        for loop in CORES:
            yield f"{loop} {preset}", loop, [*ONE, f"timing.core.preset={preset}"]
    for loop in ("stream", "stream_of_stores", "random", "rows"):
        yield f"{loop} all-cores", loop, [PLAIN]
        for machine in ("prototype", "prototype-forwarding"):
            yield f"{loop} {machine}", loop, [f"machine={machine}"]


def simulate(build, folder, loop, settings):
    """The cycles and the clock's version."""
    path = os.path.join(folder, loop)
    if not os.path.exists(path + ".elf"):
        body, rounds = LOOPS[loop]
        with open(path + ".s", "w", encoding="utf-8") as file:
            file.write(START.replace("COUNT", str(rounds)) + body + END)
        subprocess.run(["sh", ASSEMBLE, build, path + ".s", path + ".elf"], check=True)
    subprocess.run([os.path.join(build, "bin", "vorion-sim"), path + ".elf", "--set", "host_threads=1", "--time", "--stats", path + ".json",
                    "--set", ",".join(settings)], check=True, stdout=subprocess.DEVNULL)
    with open(path + ".json", encoding="utf-8") as file:
        time = json.load(file)["runs"][0]["time"]
    return time["cycles"], time["clock_version"]


def frame(folder, kind, path, machine="prototype-on-chip"):
    """The cycles of a frame of a small scene."""
    scene, cameras, report = (os.path.join(folder, kind + end) for end in (".ply", ".cameras.json", f".{path}.json"))
    subprocess.run([sys.executable, SCENE, kind, scene, cameras], check=True)
    subprocess.run(["splat", "render", scene, "--cameras", cameras, "--view", "front", "--path", path, "--time", "--json", report, "-o",
                    report + ".png"], check=True, stdout=subprocess.DEVNULL, env=dict(os.environ, VORION_CONFIG=machine))
    with open(report, encoding="utf-8") as file:
        return json.load(file)["time"]["sum"]["cycles"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--update", action="store_true")
    parser.add_argument("build")
    parser.add_argument("folder")
    args = parser.parse_args()
    os.makedirs(args.folder, exist_ok=True)
    cycles, version = {}, None
    for name, loop, settings in runs():
        cycles[name], version = simulate(args.build, args.folder, loop, settings)
    for kind in ("one", "random"):
        for path in ("raster", "simt"):
            cycles[f"frame {kind} {path}"] = frame(args.folder, kind, path)
    for machine in ("prototype", "prototype-forwarding", "scaled", "scaled-forwarding"):
        cycles[f"frame random raster {machine}"] = frame(args.folder, "random", "raster", machine)
    if args.update:
        with open(KEPT, "w", encoding="utf-8") as file:
            json.dump({"clock_version": version, "cycles": cycles}, file, indent=1)
            file.write("\n")
        print(f"{len(cycles)} runs written for version {version} of the clock")
        return 0
    with open(KEPT, encoding="utf-8") as file:
        kept = json.load(file)
    differ = {name for name in cycles.keys() | kept["cycles"].keys() if cycles.get(name) != kept["cycles"].get(name)}
    for name in sorted(differ):
        print(f"{name}: {cycles.get(name, 'no')} cycles, kept are {kept['cycles'].get(name, 'none')}")
    if version != kept["clock_version"]:
        print(f"the clock is of version {version}, the kept cycles of version {kept['clock_version']}")
    if differ or version != kept["clock_version"]:
        print("A change of the clock raises ClockVersion, says why in docs/model.md, and runs golden_cycles.py --update.")
        return 1
    print(f"{len(cycles)} runs as kept for version {version} of the clock")
    return 0


if __name__ == "__main__":
    sys.exit(main())
