#!/usr/bin/env python3
"""What kernels are compiled to: instructions, spills, registers, splits, beside scalar code of the same source.

usage: kernels.py [--json FILE] [--markdown] [--group N] [--folder FOLDER]... [-- PROGRAM [ARGUMENT ...] [-- PROGRAM ...]]

Every .cl file below a FOLDER is compiled for groups of any size, or with --group for groups of N work-items; its own folder is searched for headers. A kernel
that several files have alike is listed once. Of each OpenCL PROGRAM, the first launch of each kernel is compared.
  instr.      instructions of the kernel on lanes, its functions inlined, as `vorion-clang --resources` counts them
  scalar      instructions of one work-item by packaged clang-19, as simt_overhead.py compiles it
  spills      instructions that spill and reload: on lanes, and in the scalar code
  int, float  registers that are alive at once, at most
  splits, preds, divs  vx_split, vx_pred, divisions and square roots in the code
  warp/pass, scalar/item, lanes   what is executed, of programs: see simt_overhead.py
  stack       of programs: loads and stores of the stack that are executed in a pass of 16 work-items
  parted      of programs: vx_split and vx_pred that are executed, and of these those that divide the lanes, in per cent
A kernel that does not compile for the machine, or not as scalar code, is named with the reason. Needs scripts/env.sh.
"""

import argparse
import contextlib
import glob
import json
import math
import os
import re
import subprocess
import sys
import tempfile

from simt_overhead import LANES, compare, run, scalar_code
import command_line

POCLCC = os.path.join(os.environ.get("VORION_ROOT", ""), "pocl", "bin", "poclcc")
STACK_POINTER = 2
# lw and flw, sw and fsw.
LOADS, STORES = (0x03, 0x07), (0x23, 0x27)


def resources_to(path):
    """Options of vorion-clang that append what each function takes to a file, a line of JSON each."""
    return f'-mllvm "-vorion-resources={path}"'


def functions(path):
    """The last compilation of each function: of several group sizes, that of a launch."""
    if not os.path.exists(path):
        return {}
    with open(path, encoding="utf-8") as file:
        return {each["function"]: each for each in map(json.loads, file)}


def scalar_counts(assembly):
    """Instructions of one work-item, and those that spill and reload, as the register allocator tells."""
    with open(assembly, encoding="utf-8") as file:
        body = file.read().split("\none_item:")[1].split(".Lfunc_end")[0]
    lines = [line for line in body.splitlines() if re.match(r"\t[a-z]", line)]
    with open(assembly + ".yaml", encoding="utf-8") as file:
        told = [part for part in file.read().split("--- ")
                if re.search(r"^Name: *SpillReloadCopies$", part, re.M) and re.search(r"^Function: *one_item$", part, re.M)]
    counts = [int(number) for part in told for number in re.findall(r"Num(?:Folded)?(?:Spills|Reloads): *'?(\d+)", part)]
    return len(lines), sum(counts)


def static(kernel, resources, cache, folder):
    row = {"kernel": kernel, "instructions": resources["instructions"],
           "spills": resources["spills"]["stores"] + resources["spills"]["loads"],
           "int": resources["registers"]["integer"]["alive"], "float": resources["registers"]["float"]["alive"],
           **{key: resources[key] for key in ("splits", "predicates", "divisions", "private_bytes", "context_bytes")}}
    programs = [p for p in glob.glob(os.path.join(cache, "*", "*", "program.bc"))
                if os.path.isdir(os.path.join(os.path.dirname(p), kernel))]
    try:
        row["scalar_instructions"], row["scalar_spills"] = scalar_counts(scalar_code(kernel, programs[0], folder)[0])
    except (IndexError, TypeError, KeyError, RuntimeError) as problem:
        row["left_out"] = f"not as scalar code: {problem}"
    return row


def of_file(source, name, group, folder):
    """A row for each kernel of a file, or one that says why there is none."""
    copy = os.path.join(folder, os.path.basename(source))
    with open(source, encoding="utf-8", errors="replace") as file:
        text = file.read()
    if group:
        size = f"__attribute__((reqd_work_group_size({group}, 1, 1)))"
        text = re.sub(r"\b(__)?kernel(?=\s+(void|__attribute__))", rf"\g<0> {size}", text)
    with open(copy, "w", encoding="utf-8") as file:
        file.write(text)
    cache, resources = os.path.join(folder, "cache"), os.path.join(folder, "resources")
    variables = {"VORION_REMARKS": resources_to(resources), "VORION_COMPILE_ALL": "1", "POCL_CACHE_DIR": cache}
    done = subprocess.run([POCLCC, "-b", f'-I"{os.path.dirname(source)}"', "-o", os.path.join(folder, "binary"), copy],
                          env={**os.environ, **variables}, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          text=True, check=False, errors="replace")
    found = {kernel: each for kernel, each in functions(resources).items() if each["kernel"]}
    if not found:
        errors = re.findall(r"error: (.*)", done.stdout)
        return [{"source": name, "left_out": errors[0] if errors else "no kernel was compiled"}]
    return [{"source": name, **static(kernel, each, cache, folder)} for kernel, each in found.items()]


def executed(elf, request, folder):
    """Loads and stores of the stack, and splits and those that divided the lanes, of one launch."""
    profile = os.path.join(folder, "profile.json")
    run("vorion-sim", elf, "--args", request, f"--profile={profile}")
    with open(profile, encoding="utf-8") as file:
        instructions = [each for program in json.load(file)["programs"] for each in program["instructions"]]
    stack = sum(each["executed"] for each in instructions
                if each["code"] & 0x7F in LOADS + STORES and each["code"] >> 15 & 31 == STACK_POINTER)
    return stack, sum(each["splits"] for each in instructions), sum(each["divergent"] for each in instructions)


def of_program(command, empty, folder):
    cache, capture, resources = (os.path.join(folder, each) for each in ("cache", "capture", "resources"))
    os.makedirs(capture)
    run(*command, env={**os.environ, "VORION_CAPTURE": capture, "POCL_CACHE_DIR": cache, "VORION_REMARKS": resources_to(resources)})
    found = functions(resources)
    seen = set()
    for request in sorted(glob.glob(os.path.join(capture, "*.json")),
                          key=lambda path: int(os.path.basename(path).split("-")[0])):
        kernel = os.path.basename(request).split("-", 1)[1][:-5]
        if kernel in seen or kernel not in found:
            continue
        seen.add(kernel)
        row = {"source": os.path.basename(command[0]), **static(kernel, found[kernel], cache, folder)}
        launch = compare(request, cache, empty, folder)
        stack, splits, divided = executed(request[:-5] + ".elf", request, folder)
        groups = math.prod(size // group for size, group in zip(launch["global"], launch["local"]))
        passes = groups * -(-math.prod(launch["local"]) // LANES)
        yield {**row, **{key: launch[key] for key in ("warp_instructions_per_pass", "scalar_instructions_per_item", "ratio",
                                                      "lanes") if key in launch},
               "stack_per_pass": stack / passes, "splits_executed": splits, "splits_divided": divided}


def without_copies(rows):
    first = {}
    for row in rows:
        figures = {key: value for key, value in row.items() if key != "source"}
        first.setdefault(json.dumps(figures if "kernel" in row else row, sort_keys=True), row)
    return list(first.values())


def mean(ratios):
    return math.exp(sum(map(math.log, ratios)) / len(ratios))


def summary(rows):
    """How much more code lanes take than one work-item, and how many more instructions are executed."""
    both = [row for row in rows if "scalar_instructions" in row]
    if not both:
        return "no kernel has scalar code to compare with"
    code = mean([row["instructions"] / row["scalar_instructions"] for row in both])
    text = (f"{len(both)} kernels: {code:.2f} times the instructions of scalar code (geometric mean), "
            f"{sum(row['spills'] > 0 for row in both)} of them spill, {sum(row['scalar_spills'] > 0 for row in both)} as scalar code")
    ran = [row["ratio"] for row in rows if "ratio" in row]
    return text + (f"\n{len(ran)} launches: {mean(ran):.2f} times the instructions that scalar code executes" if ran else "")


def cells(row):
    def number(key, form="{}"):
        return form.format(row[key]) if key in row else "-"

    parted = row.get("splits_executed")
    return [row["source"], row.get("kernel", "-"), number("instructions"), number("scalar_instructions"),
            f'{number("spills")} / {number("scalar_spills")}', number("int"), number("float"), number("splits"),
            number("predicates"), number("divisions"), number("warp_instructions_per_pass", "{:.1f}"),
            number("scalar_instructions_per_item", "{:.1f}"), number("lanes", "{:.1f}"), number("stack_per_pass", "{:.1f}"),
            f'{parted} / {100 * row["splits_divided"] // parted}' if parted else "-"]


HEADINGS = ["source", "kernel", "instr.", "scalar", "spills", "int", "float", "splits", "preds", "divs", "warp/pass",
            "scalar/item", "lanes", "stack", "parted"]


def show(rows, markdown):
    table = [cells(row) for row in rows if "kernel" in row]
    # Columns of what was executed only where something was.
    used = [n for n in range(len(HEADINGS)) if n < 10 or any(row[n] != "-" for row in table)]
    if markdown:
        print("|" + "|".join(f" {HEADINGS[n]} " for n in used) + "|")
        print("|" + "|".join("---" if n < 2 else "--:" for n in used) + "|")
        for row in table:
            print("|" + "|".join(f" {row[n]} " for n in used) + "|")
    else:
        widths = [max(len(row[n]) for row in table + [HEADINGS]) for n in range(len(HEADINGS))]
        for row in [HEADINGS, *table]:
            print("  ".join(row[n].ljust(widths[n]) if n < 2 else row[n].rjust(widths[n]) for n in used).rstrip())
    print("\n" + summary(rows))
    for row in rows:
        if "left_out" in row:
            print(f"left out: {row['source']} {row.get('kernel', '')}: {row['left_out']}", file=sys.stderr)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--json", help="write the rows to this file")
    parser.add_argument("--markdown", action="store_true", help="print a table of Markdown")
    parser.add_argument("--folder", action="append", default=[], help="compile every .cl file below it")
    parser.add_argument("--group", type=int, help="work-items of a group, for files that do not say it")
    parser.add_argument("programs", nargs=argparse.REMAINDER)
    options = parser.parse_args()
    if not os.path.exists(POCLCC):
        parser.error("the OpenCL platform is not in VORION_ROOT, expected . scripts/env.sh")
    commands = [command.split() for command in " ".join(options.programs).split("-- ") if command.strip()]
    if not commands and not options.folder:
        parser.error("nothing to compile, expected --folder or a program")

    rows = []
    with contextlib.ExitStack() as stack:
        def new():
            return stack.enter_context(tempfile.TemporaryDirectory(prefix="vorion-kernels-"))

        for top in options.folder:
            paths = sorted(glob.glob(os.path.join(glob.escape(top), "**", "*.cl"), recursive=True))
            for path in paths:
                # The folder's name and the end of the path tell enough.
                end = os.path.relpath(path, top).split(os.sep)[-2:]
                name = os.path.join(os.path.basename(os.path.abspath(top)), *end)
                rows += of_file(os.path.abspath(path), name, options.group, new())
        rows = without_copies(rows)
        if commands:
            empty = os.path.join(new(), "nothing.elf")
            with open(empty[:-4] + ".cl", "w", encoding="utf-8") as file:
                file.write("kernel void nothing(void) {}\n")
            run("vorion-clang", empty[:-4] + ".cl", "-o", empty)
        for command in commands:
            rows += of_program(command, empty, new())
    show(rows, options.markdown)
    if options.json:
        with open(options.json, "w", encoding="utf-8") as file:
            json.dump({"lanes": LANES, "scalar": "clang-19 -O2, rv32imf_zicond", "kernels": rows}, file, indent=1)
            file.write("\n")
    return 0


if __name__ == "__main__":
    command_line.run(main)
