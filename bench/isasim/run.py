#!/usr/bin/env python3
"""Lane-instructions a second of the simulator, side by side with qemu-riscv32 and, where it is installed, Spike.

usage: run.py [--rounds N] [--programs NAME,...] [--json FILE] [--out DIR] [--no-observers] [--realtime]
              [--build-only | --built]

Each program of this folder is compiled twice: for the machine, where 16 lanes of every core work together, and, the
same source, for one lane as a Linux program (for Spike, as a program of its own). A round runs each on vorion-sim with
each engine that the host has, with one host thread and with two, under qemu-riscv32 and under Spike, one right after
the other. The figures are medians over the rounds, each with the greatest distance of a round from it. Rates are by
processor time. The gain of a second thread is by wall time: it needs a quiet machine, or --realtime (chrt -f, as
root). What qemu and Spike execute is counted on a machine of one lane that runs the same object code,
which is timed there, too.

The share of the limit is what the translator executes of a warp's instructions a second, of the additions of 16 words
that the host can do (limit.c): no instruction that computes takes less.

Then two builds of the simulator, with observers and without (VORION_OBSERVERS=OFF), are compared by the instructions
that callgrind counts with no observer at work.

--build-only leaves the programs in DIR, and --built measures those that are there: for hosts without the compilers.

exit codes: 0 done, 1 a result differs or a program failed, 2 usage
"""

import argparse
import json
import os
import platform
import random
import resource
import shutil
import statistics
import struct
import subprocess
import sys

FOLDER = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(FOLDER))
BUILD = os.path.join(ROOT, "build", "dev")
KERNELS = os.path.join(ROOT, "apps", "splat", "kernels")

# Repetitions on the machine and for one lane, so that each takes a good part of a second.
PROGRAMS = {"integer": (2, 150), "matmul": (4, 2), "radixsort": (15, 300), "search": (10, 250), "histogram": (40, 1000),
            "project": (1, 30)}
TITLES = {"integer": "integer mix", "matmul": "fp32 matrix product 128", "radixsort": "radix sort",
          "search": "divergent search", "histogram": "histogram, atomics", "project": "splat projection"}
OBSERVED = ("matmul", "radixsort")  # what is run with and without observers built in

# What render/Plan.cpp compiles the projection with by default, for a scene with all bands of colour.
PROJECT_DEFINES = ("-DTILE_SIZE=64", "-DSUPPORT_EXACT", "-DDILATION=0.3f", "-DALPHA_CUTOFF=1.0f",
                   "-DNEAR_LIMIT=0.2f", "-DNEAR_IS_LEFT_OUT", "-DUSE_SH1=1", "-DUSE_SH2=1", "-DUSE_SH3=1",
                   "-DUSE_VIEW_COLOR=1", "-DUSE_ANTIALIAS=0", "-DUSE_NEAR_PLANE=1", "-DUSE_FIELD_OF_VIEW=1",
                   "-DUSE_FAINT=1", "-DUSE_INTERSECT_TAGS=1")
DEVICE_COUNT, SCALAR_COUNT = 1 << 19, 1 << 14  # Gaussians
GEOMETRY_PLANES, SH_PLANES, RECORD_BYTES, SEEN_BYTES, LOCAL_BYTES = 11, 48, 48, 36, 2048
CORES = 64

TARGET = ["--target=riscv32-unknown-elf", "-march=rv32imaf_zba_zbb_zbs", "-mabi=ilp32f", "-O3"]
FREESTANDING = ["-ffreestanding", "-fno-math-errno", "-mno-relax"]
QEMU = ["qemu-riscv32", "-cpu", "rv32,zba=true,zbb=true,zbs=true"]
SPIKE = ["spike", "--isa=rv32imaf_zba_zbb_zbs", "-m2048"]
SPIKE_SHARE = 10  # it is slower: of qemu's repetitions, one in so many
ONE_LANE = {"clusters": 1, "sockets_per_cluster": 1, "cores_per_socket": 1, "lanes_per_warp": 1}


class Out:
    """Where everything is made, and what stands before a measured command."""
    prefix = []
    folder = os.path.join(ROOT, "build", "bench", "isasim")


def path(name):
    return os.path.join(Out.folder, name)


def write(name, data):
    with open(path(name), "wb" if isinstance(data, bytes) else "w") as file:
        file.write(data)


def run(*command):
    """What it prints, and its user time in seconds."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    done = subprocess.run(command, cwd=Out.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    if done.returncode:
        raise RuntimeError(f"{' '.join(command)}: exit code {done.returncode}: {done.stderr.strip()[-400:]}")
    return done.stdout, resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before


def build_c(name, device_repeats, scalar_repeats):
    def source(file):
        return os.path.join(FOLDER, file + ".c")
    for suffix, repeats in ((".elf", device_repeats), (".once", 1)):
        run("vorion-clang", "-O3", f"-DREPEATS={repeats}", source(name), source("device"), "-o", name + suffix)
    for suffix, flags in variants(scalar_repeats):
        run("clang-19", *TARGET, *FREESTANDING, "-nostdlib", "-static", "-fuse-ld=lld-19", *flags, source(name),
            source("scalar"), "-o", name + suffix)


def has_spike():
    return shutil.which(SPIKE[0]) is not None


def spike_repeats(repeats):
    return max(1, repeats // SPIKE_SHARE)


def variants(repeats):
    """Scalar programs: for qemu, the same for a machine of one lane, two that tell what one repetition executes, and for Spike."""
    image = "-Wl,-T," + path("image.ld")
    yield ".linux", [f"-DREPEATS={repeats}"]
    for suffix, number in ((".lane", repeats), (".1", 1), (".2", 2)):
        yield suffix, [f"-DREPEATS={number}", "-DCOUNTED", image]
    if has_spike():
        yield ".spike", [f"-DREPEATS={spike_repeats(repeats)}", "-DSPIKE", image]


def scene(prefix, count):
    """View, geometry and colours of Gaussians in front of a camera; splat/kernels/layout.h has the layout."""
    rng = random.Random(1)
    focal, size = 800.0, (960, 544)
    view = [1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, focal, focal, size[0] / 2, size[1] / 2,
            -0.78, -0.442, 0.78, 0.442]
    tiles = [(s + 63) // 64 for s in size]
    write(prefix + "view.bin", struct.pack("<31f5I", *view, *size, *tiles, 0))
    planes = [lambda: rng.uniform(-3, 3), lambda: rng.uniform(-2, 2), lambda: rng.uniform(0.1, 8)]
    planes += [lambda: rng.uniform(-5, -2)] * 3 + [lambda: rng.gauss(0, 1)] * 4 + [lambda: rng.gauss(0, 2)]
    assert len(planes) == GEOMETRY_PLANES
    pool = [[make() for _ in range(4096)] for make in planes]
    geometry = [pool[p] * (count // 4096) for p in range(GEOMETRY_PLANES)]
    write(prefix + "geometry.bin", b"".join(struct.pack(f"<{count}f", *plane) for plane in geometry))
    colours = [rng.gauss(0, 0.3) for _ in range(4096)] * (count // 4096)
    write(prefix + "sh.bin", struct.pack(f"<{count}f", *colours) * SH_PLANES)


def build_project(device_repeats, scalar_repeats):
    assert device_repeats == 1
    write("project.cl", f'#pragma OPENCL FP_CONTRACT OFF\n#include "{os.path.join(KERNELS, "project.cl")}"\n')
    scene("device-", DEVICE_COUNT)
    scene("", SCALAR_COUNT)
    run("vorion-clang", "-O3", *PROJECT_DEFINES, "project.cl", "-o", "project.elf")
    # The same kernel and OpenCL's built-in functions, for a group of one lane: a plain function, into which the
    # library's are inlined (they were compiled with -fno-builtin and go into nothing else).
    pocl = os.path.join(BUILD, "pocl", "share", "pocl")
    includes = [flag for file in ("_builtin_renames.h", "opencl-c-base.h", "opencl-c.h") for flag in ("-include", file)]
    run("clang-19", *TARGET, "-x", "cl", "-cl-std=CL1.2", "-D__kernel=",
        "-Dreqd_work_group_size(x,y,z)=", "-DLANES=1", "-fno-builtin", "-I", os.path.join(pocl, "include"), *includes,
        *PROJECT_DEFINES, "-emit-llvm", "-c", "project.cl", "-o", "kernel.bc")
    for suffix, flags in variants(scalar_repeats):
        compiled = []
        for file in ("project", "scalar"):
            compiled.append(file + suffix + ".bc")
            run("clang-19", *TARGET, *FREESTANDING, f"-DCOUNT={SCALAR_COUNT}", *(f for f in flags if f.startswith("-D")),
                "-emit-llvm", "-c", os.path.join(FOLDER, file + ".c"), "-o", compiled[-1])
        run("llvm-link-19", *compiled, "kernel.bc", "-o", "program.bc")
        run("llvm-link-19", "--internalize", "--only-needed", "program.bc", os.path.join(pocl, "kernel-vorion.bc"),
            "-o", "linked.bc")
        run("clang-19", *TARGET, *FREESTANDING, "-nostdlib", "-static", "-fuse-ld=lld-19", *flags, "linked.bc",
            "-o", "project" + suffix)


def build(names):
    os.makedirs(Out.folder, exist_ok=True)
    image = ""
    for file in (os.path.join(BUILD, "intrinsics", "generated", "vorion_numbers.ld"),
                 os.path.join(ROOT, "libdevice", "start", "vorion.ld")):
        with open(file, encoding="utf-8") as text:
            image += text.read()
    write("image.ld", image)
    write("one-lane.json", json.dumps(ONE_LANE))
    run("clang-19", "-O2", os.path.join(FOLDER, "limit.c"), "-o", "limit")
    for name in names:
        if name == "project":
            build_project(*PROGRAMS[name])
        else:
            build_c(name, *PROGRAMS[name])


def arguments(name):
    if name != "project":
        return []
    count = DEVICE_COUNT
    items = 16 * CORES
    args = ["buf@device-view.bin", "buf@device-geometry.bin", "buf@device-sh.bin", f"buf:{RECORD_BYTES * count}",
            f"out:{4 * count}@depths.bin", f"buf:{8 * count}", f"buf:{SEEN_BYTES * items}", f"u32:{count}",
            f"local:{LOCAL_BYTES}"]
    return ["--global", str(items), "--local", "16", *(word for arg in args for word in ("--arg", arg))]


def simulate(name, *options):
    """What the program printed, and the run's statistics."""
    text, _ = run(*Out.prefix, "vorion-sim", name, "--stats", "stats.json", *options)
    with open(path("stats.json"), encoding="utf-8") as file:
        return text.splitlines()[0], json.load(file)


def count_scalar(name):
    """Instructions that one repetition executes, and one lane's result."""
    one, two = (simulate(f"{name}.{n}", "--config", "one-lane.json") for n in (1, 2))
    return two[1]["total"]["lane_instructions"] - one[1]["total"]["lane_instructions"], one[0]


def depths_sum():
    """What project.c's work() computes, from the device's depths."""
    with open(path("depths.bin"), "rb") as file:
        depths = struct.unpack(f"<{SCALAR_COUNT}I", file.read(4 * SCALAR_COUNT))
    total = 0
    for depth in depths:
        total = (total * 31 + depth) & 0xFFFFFFFF
    return f"{total:08x}"


def has_translator(name):
    """Whether the host has what the other engine needs."""
    try:
        simulate(name + ".elf", "--set", "engine=translator", *arguments(name))
    except RuntimeError as error:
        if "engine is the translator" in str(error):
            return False
        raise
    return True


def limits():
    """What limit.c prints: additions of 16 words a second, by engine."""
    text, _ = run(*Out.prefix, "./limit")
    return {engine: float(number) for engine, number in (line.split() for line in text.splitlines())}


def spread(values):
    """How far the value that is furthest away from the median is, as a share of the median."""
    middle = statistics.median(values)
    return max(abs(value / middle - 1) for value in values)


class Rate:
    """Instructions a second, over the rounds."""

    def __init__(self, instructions, seconds):
        self.value = instructions / statistics.median(seconds)
        self.spread = spread(seconds)
        self.seconds = seconds

    def json(self):
        return {"instructions_per_second": self.value, "spread": self.spread, "seconds": self.seconds}

    def __str__(self):
        return f"{self.value / 1e9:.2f} ±{100 * self.spread:.0f} %"


def measure(name, rounds):
    device_repeats, scalar_repeats = PROGRAMS[name]
    instructions, expected = count_scalar(name)
    engines = ["interpreter"] + (["translator", "translator-avx2"] if has_translator(name) else [])
    stats = {(engine, threads): [] for engine in engines for threads in (1, 2)}
    others = {"qemu": (scalar_repeats, [*QEMU, f"./{name}.linux"], [])}
    if has_spike():
        others["spike"] = (spike_repeats(scalar_repeats), [*SPIKE, name + ".spike"], [])
    total, most, alone = None, [], []
    for _ in range(rounds):
        most.append(limits())
        if "translator" in engines:
            text, run_stats = simulate(name + ".lane", "--set", "host_threads=1", "--config", "one-lane.json")
            if text != expected:
                raise RuntimeError(f"{name}: {text} translated for one lane, {expected} expected")
            alone.append(run_stats["host_cpu_seconds"])
        for (engine, threads), into in stats.items():
            text, run_stats = simulate(name + ".elf", "--set", f"host_threads={threads}", "--set", "engine=" + engine, *arguments(name))
            text = depths_sum() if name == "project" else text
            if text != expected:
                raise RuntimeError(f"{name}: {text} on 16 lanes, {expected} on one")
            total = total or run_stats["total"]
            if run_stats["total"] != total:
                raise RuntimeError(f"{name}: other counters with {threads} threads and the {engine}")
            into.append(run_stats)
        for other, (_, command, seconds) in others.items():
            text, taken = run(*Out.prefix, *command)
            if text.strip() != expected:
                raise RuntimeError(f"{name}: {text.strip()} under {other}, {expected} on one lane of vorion-sim")
            seconds.append(taken)
    rates = {engine: Rate(total["lane_instructions"], [s["host_cpu_seconds"] for s in stats[engine, 1]])
             for engine in engines}
    rates |= {other: Rate(instructions * repeats, seconds) for other, (repeats, _, seconds) in others.items()}
    if alone:
        rates["lane"] = Rate(instructions * scalar_repeats, alone)
    lanes = total["lane_instructions"] / total["warp_instructions"]
    shares = {engine: rates[engine].value / lanes / statistics.median(limit[engine] for limit in most)
              for engine in engines if engine in most[0]}
    gains = {engine: [one["host_seconds"] / two["host_seconds"] for one, two in zip(stats[engine, 1], stats[engine, 2])]
             for engine in engines}
    return {"program": name, "lane_instructions": total["lane_instructions"],
            "active_lanes": lanes, "share_of_limit": shares,
            "scalar_instructions_a_repetition": instructions,
            "rates": rates, "two_threads_over_one": {engine: statistics.median(gain) for engine, gain in gains.items()}}


def observer_cost(names):
    """Instructions of one core's run in simulators with and without observers, none at work, by callgrind."""
    with open(path("small.json"), "w", encoding="utf-8") as file:
        json.dump({"clusters": 1, "sockets_per_cluster": 1, "cores_per_socket": 1}, file)
    counts = {}
    for state in ("ON", "OFF"):
        tree = path("observers-" + state.lower())
        run("cmake", "-S", ROOT, "-B", tree, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_C_COMPILER=clang-19",
            "-DCMAKE_CXX_COMPILER=clang++-19", "-DVORION_COMPONENTS=intrinsics;support;isasim",
            f"-DVORION_OBSERVERS={state}")
        run("cmake", "--build", tree, "--target", "vorion-sim", "-j", "2")
        for name in names:
            run("valgrind", "--tool=callgrind", "--callgrind-out-file=callgrind.out", "--log-file=callgrind.log",
                os.path.join(tree, "bin", "vorion-sim"), name + ".once", "--set", "host_threads=1", "--config", "small.json")
            with open(path("callgrind.log"), encoding="utf-8") as file:
                collected = next(line for line in file if "Collected" in line)
            counts.setdefault(name, {})[state] = int(collected.split()[-1])
    return counts


def host():
    model = platform.processor() or platform.machine()
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        for line in file:
            if line.startswith(("model name", "cpu family", "model\t", "cpu MHz")):
                key, value = (part.strip() for part in line.split(":", 1))
                model = value if key == "model name" else f"{model}, {key} {value}"
            elif not line.strip():
                break
    return f"{model}, {os.cpu_count()} processors"


COLUMNS = {"interpreter": "interpreter", "translator": "translator", "translator-avx2": "translator, AVX2",
           "qemu": "qemu-riscv32", "spike": "Spike", "lane": "one lane"}


def table(results):
    yield (f"| program | active lanes | {' | '.join(COLUMNS.values())} | translator over qemu | AVX2 over qemu | "
           "one lane over qemu | translator's share of the limit | AVX2's | 2 threads over 1 |")
    yield "|---|" + "--:|" * (len(COLUMNS) + 7)
    for r in results:
        rates, gains, shares = r["rates"], r["two_threads_over_one"], r["share_of_limit"]

        def over(engine):
            return f"{rates[engine].value / rates['qemu'].value:.2f}x" if engine in rates else ""

        def share(engine):
            return f"{100 * shares[engine]:.0f} %" if engine in shares else ""
        cells = [str(rates.get(key, "")) for key in COLUMNS]
        fast = ("translator", "translator-avx2")
        yield (f"| {TITLES[r['program']]} | {r['active_lanes']:.1f} | {' | '.join(cells)} | {' | '.join(map(over, (*fast, 'lane')))} | "
               f"{' | '.join(map(share, fast))} | {gains.get('translator', gains['interpreter']):.2f}x |")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rounds", type=int, default=5, help="medians are over these (default: 5)")
    parser.add_argument("--programs", default=",".join(PROGRAMS), help="default: %(default)s")
    parser.add_argument("--out", default=Out.folder, help="default: build/bench/isasim")
    parser.add_argument("--json", help="default: results.json in OUT")
    parser.add_argument("--no-observers", action="store_true", help="leave out the two builds of the simulator")
    parser.add_argument("--realtime", action="store_true", help="measure under chrt -f, undisturbed by other work (as root)")
    alone = parser.add_mutually_exclusive_group()
    alone.add_argument("--build-only", action="store_true", help="measure nothing")
    alone.add_argument("--built", action="store_true", help="measure the programs that OUT has, on a host without compilers; "
                       "needs --no-observers")
    options = parser.parse_args()
    Out.prefix = ["chrt", "-f", "10"] if options.realtime else []
    Out.folder = os.path.abspath(options.out)
    names = options.programs.split(",")
    unknown = [name for name in names if name not in PROGRAMS]
    if unknown or options.rounds < 1:
        parser.error(f"--programs {options.programs} --rounds {options.rounds}, expected some of {','.join(PROGRAMS)} and "
                     "at least one round")
    if options.built and not options.no_observers:
        parser.error("--built has no compiler for the simulators without observers, expected --no-observers with it")
    if not options.built:
        build(names)
    if options.build_only:
        return 0
    results = []
    for name in names:
        results.append(measure(name, options.rounds))
        print(f"{name}: interpreter {results[-1]['rates']['interpreter']}", file=sys.stderr)
    costs = {} if options.no_observers else observer_cost([name for name in OBSERVED if name in names])
    report = {"host": host(), "rounds": options.rounds, "programs": results,
              "instructions_with_and_without_observers": costs}
    write(os.path.abspath(options.json or path("results.json")), json.dumps(report, indent=1, default=Rate.json) + "\n")
    print(f"{host()}; billions of lane-instructions a second of processor time, medians of {options.rounds} rounds")
    print("\n".join(table(results)))
    for name, count in costs.items():
        print(f"{TITLES[name]}, observers built in but off: {count['ON']} host instructions, {count['OFF']} without them "
              f"({100 * (count['ON'] / count['OFF'] - 1):+.2f} %)")
    return 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except RuntimeError as error:
        print(f"run.py: error: {error}", file=sys.stderr)
        sys.exit(1)
