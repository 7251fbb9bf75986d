#!/usr/bin/env python3
"""What running on lanes costs: a kernel's warp instructions against one work-item's as scalar code.

usage: simt_overhead.py [--json FILE] [--keep FOLDER] PROGRAM [ARGUMENT ...] [-- PROGRAM ...]

Runs each OpenCL program once with VORION_CAPTURE, and for the first launch of each kernel compares
  simt    warp instructions of the launch on 16 lanes, less those of an empty kernel with the same grid, for each
          pass of 16 work-items;
  scalar  instructions of a work-item on average: the same OpenCL C, as PoCL's front end leaves it, compiled by
          packaged clang-19 -O2 for rv32imf_zicond (with A where the kernel has atomics) and run with the same
          buffers, one work-item after the other on one lane. Of large launches every n-th group is taken.
  work    the ratio of the two times the lanes that were active over 16: what a work-item executes on its lane, against
          its scalar code. It leaves out what lanes cost that are off.
"uniform" says that the kernel's code has no split and no predicate; others say how often lanes parted. Needs scripts/env.sh; no test, as bench/README.md says.
"""

import argparse
import glob
import json
import math
import os
import re
import subprocess
import sys
import tempfile

import command_line

HERE = os.path.dirname(os.path.abspath(__file__))
LANES = 16
MOST_ITEMS = 20000  # of a launch, as scalar code
ONE_LANE = {"sockets_per_cluster": 1, "cores_per_socket": 1, "lanes_per_warp": 1}
SIZES = {"ptr": 4, "i8": 1, "i16": 2, "i32": 4, "i64": 8, "float": 4}
PLAIN = ["--target=riscv32-unknown-elf", "-mabi=ilp32f", "-O2", "-S", "-w"]


def run(*command, **options):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False, **options)
    if done.returncode != 0:
        said = (done.stderr or done.stdout).strip().splitlines()
        raise RuntimeError(f"{command[0]}: {said[-1] if said else f'ended with {done.returncode}'}")
    return done.stdout


def simulate(elf, request, folder, config=None):
    """The run's counters and what it printed. The request's buffers are read only."""
    stats, asked = (os.path.join(folder, name) for name in ("stats.json", "request.json"))
    with open(asked, "w", encoding="utf-8") as file:
        json.dump(request, file)
    options = ["--config", config] if config else []
    printed = run("vorion-sim", elf, "--args", asked, "--stats", stats, *options)
    with open(stats, encoding="utf-8") as file:
        return json.load(file), printed


def size_of(kind):
    if kind in SIZES:
        return SIZES[kind]
    vector = re.fullmatch(r"<(\d+) x (\w+)>", kind)
    return 2 ** math.ceil(math.log2(int(vector[1]) * SIZES[vector[2]]))


def parameters(text, kernel):
    """LLVM types of the kernel's parameters."""
    header = re.search(rf"^define [^\n]*@{kernel}\((.*)\)[^()]*\{{$", text, re.M)[1]
    found = []
    depth = start = 0
    for at, char in enumerate(header + ","):
        depth += (char in "(<[{") - (char in ")>]}")
        if char == "," and depth == 0:
            part = header[start:at].strip()
            start = at + 1
            if part:
                if "byval" in part:
                    raise RuntimeError("a structure by value")
                found.append(re.match(r"<[^>]*>|\S+", part)[0])
    return found


def scalar_code(kernel, program, folder):
    """The assembly of one work-item, offset and size of each argument, and the bytes of all."""
    text = run("llvm-dis-19", program, "-o", "-")
    if re.search(r"@vorion\.v[rx]_", text[text.index(f"@{kernel}("):].split("\n}\n")[0]):
        raise RuntimeError("uses the machine's own instructions")
    text = re.sub(r' "(target-features|target-cpu|tune-cpu|no-builtins)"(="[^"]*")?', "", text)
    # The library's functions are inlined by PoCL later, whatever they ask for.
    text = re.sub(r"^(attributes #\d+ = .*)$", lambda m: re.sub(r"\b(optnone|noinline) ", "", m[0]), text, flags=re.M)
    text = re.sub(r"= external local_unnamed_addr constant", "= external global", text)
    types = parameters(text, kernel)
    end, offsets, loads = 0, [], []
    for n, kind in enumerate(types):
        size = size_of(kind)
        at = -(-end // size) * size
        offsets.append((at, size))
        end = at + size
        loads.append(f"  %p{n} = getelementptr i8, ptr %args, i32 {at}\n  %v{n} = load {kind}, ptr %p{n}, align 4\n")
    call = ", ".join(f"{kind} %v{n}" for n, kind in enumerate(types))
    text += (f"\ndefine void @one_item(ptr %args) {{\n{''.join(loads)}"
             f"  call spir_kernel void @{kernel}({call})\n  ret void\n}}\n")
    source = os.path.join(folder, "program.ll")
    with open(source, "w", encoding="utf-8") as file:
        file.write(text)
    only = os.path.join(folder, "only.bc")
    run("/usr/lib/llvm-19/bin/opt", "-passes=strip-dead-debug-info,strip,internalize,globaldce",
        "-internalize-public-api-list=one_item", source, "-o", only)
    march = "-march=rv32im" + "a" * ("atomicrmw" in run("llvm-dis-19", only, "-o", "-")) + "f_zicond"
    assembly = os.path.join(folder, "program.s")
    run("clang-19", *PLAIN, march, only, "-o", assembly, "-foptimization-record-passes=regalloc",
        f"-foptimization-record-file={assembly}.yaml")
    with open(assembly, encoding="utf-8") as file:
        lines = [line for line in file if not line.lstrip().startswith(".attribute")]
    with open(assembly, "w", encoding="utf-8") as file:
        file.writelines(lines)
    return assembly, offsets, end


def scalar(kernel, program, request, kinds, folder):
    """Items run, their instructions."""
    assembly, offsets, end = scalar_code(kernel, program, folder)
    groups = math.prod(g // l for g, l in zip(request["global"], request["local"]))
    items = math.prod(request["local"])
    stride = max(1, groups * items // MOST_ITEMS)
    rows = ",".join(f'{{(uint)"", {kind}, {at}, {size}}}' for kind, (at, size) in zip(kinds, offsets)) or "{0,0,0,0}"
    elf = os.path.join(folder, "scalar.elf")
    run("vorion-clang", "-O2", "-w", f'-DKERNEL_NAME="{kernel}"', f"-DARGUMENTS={rows}",
        f"-DNUM_ARGUMENTS={len(offsets)}", f"-DARGUMENTS_BYTES={end}", "-DLOCAL_BYTES=0", f"-DSTRIDE={stride}",
        assembly, os.path.join(HERE, "overhead", "one_item.c"), "-o", elf)
    config = os.path.join(folder, "one-lane.json")
    with open(config, "w", encoding="utf-8") as file:
        json.dump(ONE_LANE, file)
    printed = simulate(elf, request, folder, config)[1]
    counts = re.search(r"items (\d+) instructions (\d+)", printed)
    return int(counts[1]), int(counts[2])


def argument_kinds(elf, kernel):
    listed = re.search(rf"^{kernel}\((.*)\)$", run("vorion-sim", elf, "--list-kernels"), re.M)[1]
    names = {"global": "VX_ARG_GLOBAL", "local": "VX_ARG_LOCAL", "value": "VX_ARG_VALUE",
             "integer": "VX_ARG_INTEGER", "float": "VX_ARG_FLOAT"}
    return [names[part.split()[0]] for part in listed.split(", ")] if listed else []


def compare(request_file, cache, empty, folder):
    with open(request_file, encoding="utf-8") as file:
        request = json.load(file)
    kernel, elf = request["kernel"], request_file[:-5] + ".elf"
    row = {"kernel": kernel, "global": request["global"], "local": request["local"]}
    nothing = simulate(empty, {**request, "kernel": "nothing", "args": []}, folder)[0]["total"]["warp_instructions"]
    total = simulate(elf, request, folder)[0]["total"]
    groups = math.prod(g // l for g, l in zip(request["global"], request["local"]))
    passes = groups * -(-math.prod(request["local"]) // LANES)
    row["warp_instructions_per_pass"] = (total["warp_instructions"] - nothing) / passes
    row["divergent_splits"] = total["divergent_splits"]
    row["lanes"] = total["lane_instructions"] / total["warp_instructions"]
    code = run("vorion-objdump", "-d", f"--disassemble-symbols={kernel}", elf)
    row["uniform"] = not re.search(r"\bvx_(split|pred)", code)
    programs = [p for p in glob.glob(os.path.join(cache, "*", "*", "program.bc"))
                if os.path.isdir(os.path.join(os.path.dirname(p), kernel))]
    try:
        items, instructions = scalar(kernel, programs[0], request, argument_kinds(elf, kernel), folder)
        row["scalar_instructions_per_item"] = instructions / items
        row["ratio"] = row["warp_instructions_per_pass"] / row["scalar_instructions_per_item"]
        row["work"] = row["ratio"] * row["lanes"] / LANES
    except RuntimeError as problem:
        row["left_out"] = str(problem)
    return row


def commands_of(words):
    """The programs with their arguments, which "--" parts."""
    found = [[]]
    for word in words:
        if word == "--":
            found.append([])
        else:
            found[-1].append(word)
    return [command for command in found if command]


def measure(commands, folder):
    """Prints a row for each kernel, and returns them."""
    nothing = os.path.join(folder, "nothing.cl")
    with open(nothing, "w", encoding="utf-8") as file:
        file.write("kernel void nothing(void) {}\n")
    empty = os.path.join(folder, "nothing.elf")
    run("vorion-clang", nothing, "-o", empty)

    rows = []
    print(f"{'program':14} {'kernel':14} {'warp/pass':>10} {'scalar/item':>11} {'ratio':>6} {'lanes':>6} {'work':>6}  flow")
    for number, command in enumerate(commands):
        capture, cache = (os.path.join(folder, f"{kind}{number}") for kind in ("capture", "cache"))
        os.makedirs(capture, exist_ok=True)
        run(*command, env={**os.environ, "VORION_CAPTURE": capture, "POCL_CACHE_DIR": cache})
        seen = set()
        requests = glob.glob(os.path.join(capture, "*.json"))
        for request in sorted(requests, key=lambda path: int(os.path.basename(path).split("-")[0])):
            kernel = os.path.basename(request).split("-", 1)[1][:-5]
            if kernel in seen:
                continue
            seen.add(kernel)
            row = {"program": os.path.basename(command[0]), **compare(request, cache, empty, folder)}
            rows.append(row)
            flow = "uniform" if row["uniform"] else f"{row['divergent_splits']} partings"
            figures = (f"{row['scalar_instructions_per_item']:11.1f} {row['ratio']:6.2f}" if "ratio" in row
                       else f"{'-':>11} {'-':>6}")
            work = f"{row['work']:6.2f}" if "work" in row else f"{'-':>6}"
            print(f"{row['program']:14} {kernel:14} {row['warp_instructions_per_pass']:10.1f} {figures} "
                  f"{row['lanes']:6.2f} {work}  {flow}{': ' + row['left_out'] if 'left_out' in row else ''}", flush=True)
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--json")
    parser.add_argument("--keep", help="folder for what is made (default: a temporary one)")
    parser.add_argument("programs", nargs=argparse.REMAINDER)
    options = parser.parse_args()
    commands = commands_of(options.programs)
    for command in commands or [[]]:
        command_line.check_program(parser, command)
    try:
        if options.keep:
            folder = os.path.abspath(options.keep)
            os.makedirs(folder, exist_ok=True)
            rows = measure(commands, folder)
        else:
            with tempfile.TemporaryDirectory(prefix="vorion-overhead-") as folder:
                rows = measure(commands, folder)
    except RuntimeError as problem:
        print(f"simt_overhead.py: error: {problem}, expected it to end well", file=sys.stderr)
        return 1
    if options.json:
        with open(options.json, "w", encoding="utf-8") as file:
            json.dump({"lanes": LANES, "scalar": "clang-19 -O2, rv32imf_zicond", "kernels": rows}, file, indent=1)
            file.write("\n")
    return 0


if __name__ == "__main__":
    command_line.run(main)
