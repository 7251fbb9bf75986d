#!/usr/bin/env python3
"""How long OpenCL C takes to become an image, and where: seconds of processor time (user) a step, of all processes.

usage: compile_time.py [--json FILE] [--runs N] (REPORT.json | KERNEL.cl ...)

A report of `splat render --json` stands for the programs that it names, with their definitions. Steps:
  front end    PoCL's clang with the OpenCL headers, and the kernel library linked in
  groups       PoCL's work-group passes and its own start
  optimise     vorion-clang -O2, IR to IR
  code         vorion-clang, divergence lowering, selection, allocation, emission
  link         vorion-link
The least of N runs counts, since other programs share the machine. Needs scripts/env.sh.
"""

import argparse
import glob
import json
import os
import shutil
import subprocess
import sys
import tempfile

import command_line
import processor_time

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
BUILD = os.environ.get("VORION_ROOT") or os.path.join(ROOT, "build", "dev")


def user_time(*command, **environment):
    before, _ = processor_time.of_ended()
    done = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, check=False,
                          env={**os.environ, **environment})
    if done.returncode != 0:
        sys.exit(f"compile_time: error: {' '.join(command)}: {done.stderr.strip()}")
    after, _ = processor_time.of_ended(wait=True)
    return after - before


def sources(inputs, folder):
    """Names and files to compile."""
    for name in inputs:
        if not name.endswith(".json"):
            yield os.path.basename(name), name
            continue
        with open(name, encoding="utf-8") as file:
            programs = json.load(file)["programs"]
        for program in programs:
            path = os.path.join(folder, program["name"] + ".cl")
            with open(path, "w", encoding="utf-8") as out:
                for define in program["defines"]:
                    out.write("#define " + define.replace("=", " ", 1) + "\n")
                for root in program["files"]:
                    out.write(f'#include "{os.path.join(ROOT, "apps", "splat", "kernels", root)}"\n')
            yield program["name"], path


def measure(source, folder):
    cache = os.path.join(folder, "cache")
    shutil.rmtree(cache, ignore_errors=True)
    os.makedirs(cache)
    environment = {"POCL_CACHE_DIR": cache, "POCL_LEAVE_KERNEL_COMPILER_TEMP_FILES": "1", "VORION_COMPILE_ALL": "1",
                   "OCL_ICD_VENDORS": os.path.join(BUILD, "etc", "OpenCL", "vendors"), "VORION_ROOT": BUILD}
    image = os.path.join(folder, "image.elf")
    whole = user_time("vorion-clang", source, "-o", image)
    poclcc = [os.path.join(BUILD, "pocl", "bin", "poclcc"), "-o", os.path.join(folder, "binary"), source]
    user_time(*poclcc, **environment)
    kernels = glob.glob(os.path.join(cache, "*", "*", "*", "*", "*.bc"))
    optimise = code = link = 0.0
    for kernel in kernels:
        better, done = (os.path.join(folder, "kernel" + suffix) for suffix in (".opt.bc", ".o"))
        optimise += user_time("vorion-clang", "-O2", "-c", "-emit-llvm", kernel, "-o", better)
        code += user_time("vorion-clang", "-O2", "-Xclang", "-disable-llvm-passes", "-c", better, "-o", done)
        link += user_time("vorion-link", done, "-o", image)
    # Without the kernels but with the program, PoCL does all but the front end.
    for kernel in kernels:
        shutil.rmtree(os.path.dirname(os.path.dirname(kernel)))
    behind = user_time(*poclcc, **environment)
    groups = max(0.0, behind - optimise - code - link)
    steps = {"front end": whole - groups - optimise - code - link, "groups": groups, "optimise": optimise,
             "code": code, "link": link}
    return {"kernels": len(kernels), "whole": whole, **steps}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--json")
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("inputs", nargs="+")
    options = parser.parse_args()
    rows = []
    processor_time.adopt_orphans()
    steps = ["whole", "front end", "groups", "optimise", "code", "link"]
    with tempfile.TemporaryDirectory() as folder:
        print(f"{'program':12} {'kernels':>7}" + "".join(f"{step:>10}" for step in steps))
        for name, source in sources(options.inputs, folder):
            row = {"program": name, **min((measure(source, folder) for _ in range(options.runs)),
                                          key=lambda r: r["whole"])}
            rows.append(row)
            print(f"{name:12} {row['kernels']:7}" + "".join(f"{row[step]:10.3f}" for step in steps), flush=True)
    if options.json:
        with open(options.json, "w", encoding="utf-8") as file:
            json.dump({"unit": "s of user time", "programs": rows}, file, indent=1)
            file.write("\n")


if __name__ == "__main__":
    command_line.run(main)
