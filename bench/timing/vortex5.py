#!/usr/bin/env python3
"""Several warps and several cores of `vortex-5stage` beside Vortex's RTL of May 2023, as Markdown tables.

usage: vortex5.py [--known FILE] REFERENCES

REFERENCES is a folder with vortex5_warps.json, vortex5_cores.json or both, vortex_core_cpi.json and vortex5_kernels/: loops
and whole kernels on a core with 1, 2 and 4 warps, and on 1, 2 and 4 cores that share an L2. A loop's number is the
difference of two runs divided by that of their iterations. A kernel's is from the first instruction to the last warp's end,
without the cycles in which the RTL's caches clear their lines; both ran the same image of memory.

FILE, by default vortex5_known.json beside this program, lists what is further off and why. Each of its entries has the error
in per cent that it is expected to have, so a change of it is an error, for the better too.

exit codes: 0 all comparable loops within 5 %, kernels within 10 % and their geometric means within 3 %, or as FILE expects; 1
not so, 2 usage
"""

import argparse
import json
import math
import os
import sys
import tempfile

sys.path.append(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
import clocked
import command_line
import cores
import kernels

HERE = os.path.dirname(os.path.abspath(__file__))
OF_LOOP, OF_KERNEL, OF_MEAN = 0.05, 0.10, 0.03
OF_KNOWN = 0.005  # a known error may differ by so much from what is expected of it
MEAN = "geometric mean"
PRESET = "vortex-5stage"
CACHES = ("timing.socket.icache_kib=16", "timing.socket.icache_ways=1", "timing.core.interleaved_stacks=0")
# Where local memory is, and how lanes share its banks.
PLACES = {"LOCAL_BASE": "0xffff0000", "LANE_SHIFT": "2", "WORD_SHIFT": "6"}


class Warps:
    """A core without L2. Memory answers after 50 cycles, and 9 more for the queues on the way."""
    FILE, WHAT, CLEARING = "vortex5_warps.json", "1, 2 and 4 warps", 256
    LOOPS = KERNELS = ("1", "2", "4")
    CHANGES = (*CACHES, "timing.l2.fixed_cycles=59")

    @staticmethod
    def of_loop(_, column):
        """(cores, warps of each)."""
        return 1, int(column)

    @staticmethod
    def of_kernel(column):
        return 1, int(column)


class Cores:
    """Cores with an L2 of the RTL's values. Memory answers 50 cycles after it has taken a request, at the next one's edge."""
    FILE, WHAT, CLEARING = "vortex5_cores.json", "1, 2 and 4 cores on an L2", 4095
    LOOPS = ("1", "2", "4")
    KERNELS = ("1x1", "2x1", "4x1", "1x2", "2x2", "4x2")
    CHANGES = (*CACHES, "timing.l2.crossbar=1", "timing.l2.write_through=1", "timing.l2.ways=1", "timing.l2.hit_cycles=12",
               "timing.l2.intersect_hint=0", "timing.llc.constant_cycles=51")

    @staticmethod
    def of_loop(loop, column):
        return int(column), loop["warps_per_core"]

    @staticmethod
    def of_kernel(column):
        return tuple(map(int, column.split("x")))


def changes(run, shape):
    return (*run.CHANGES, f"sockets_per_cluster={shape[0]}")


def placed(text):
    for name, value in PLACES.items():
        text = text.replace(name, value)
    return text


def placed_copy(folder, source):
    """A copy of \\p source with our local memory. Parts of both folders have equal names."""
    copy = os.path.join(folder, os.path.basename(os.path.dirname(source)) + "-" + os.path.basename(source))
    with open(source) as file, open(copy, "w") as out:
        out.write(placed(file.read()))
    return copy


def built(folder, name, sources):
    """The program \\p name of assembly files, made once."""
    program = os.path.join(folder, name + ".elf")
    if not os.path.exists(program):
        kernels.linked([kernels.assembled(folder, placed_copy(folder, source)) for source in sources], program)
    return program


def program_of(folder, references, name):
    """The program of a kernel."""
    here, own = kernels.HERE, os.path.join(references, "vortex5_kernels")
    sources = [os.path.join(here, "start.s"), os.path.join(here, "compiled", name + ".s"), os.path.join(here, "inputs.s")]
    if name.startswith("own_"):
        sources = [os.path.join(own, part) for part in ("start.s", name + ".s", "inputs.s")]
    return built(folder, name, sources)


def per_iteration(folder, references, run, loop, column):
    """Cycles of an iteration of \\p loop, which all warps of all cores run."""
    shape, took = run.of_loop(loop, column), []
    for iterations in loop["iterations"]:
        name = f"{loop['name']}.{iterations}"
        source = os.path.join(folder, name + ".s")
        with open(source, "w") as file:
            file.write(loop["assembly"].replace("ITERS", str(iterations)))
        program = built(folder, name, [os.path.join(references, "vortex5_kernels", "start.s"), source])
        took.append(cores.time_of(program, PRESET, shape[1], changes(run, shape))["cycles"])
    few, many = loop["iterations"]
    return (took[1] - took[0]) / (many - few)


def known_errors(path):
    """{(file of references, row, column): the error that is expected}"""
    with open(path) as file:
        return {(each["references"], each["row"], each["column"]): each["error_percent"] / 100 for each in json.load(file)}


def wrong_error(error, limit, expected):
    """What is wrong with \p error, or nothing: it is beyond \p limit, or not what is \p expected of a known one."""
    if expected is None:
        return f"{100 * error:+.1f} %, expected 0 within {100 * limit:.0f} %" if abs(error) > limit else None
    if abs(error) <= limit:
        return f"{100 * error:+.1f} %, which is within {100 * limit:.0f} %, but known as {100 * expected:+.1f} %"
    if abs(error - expected) > OF_KNOWN:
        return f"{100 * error:+.1f} %, expected {100 * expected:+.1f} %, as is known, within {100 * OF_KNOWN} %"
    return None


class Table:
    """Rows of a name and, for each column, our cycles, the RTL's and the error. \p known: {(row, column): error}."""

    def __init__(self, program, what, columns, limit, known):
        self.limit, self.columns, self.known, self.wrong = limit, columns, known, []
        self.ratios = {column: [] for column in columns}
        print(f"\n{what}:\n")
        print(f"| {program} |" + "".join(f" {column}: ours | RTL | error |" for column in columns))
        print("|---|" + "--:|--:|--:|" * len(columns))

    def row(self, name, cells, comparable=True):
        """\\p cells: {column: (ours, the RTL's)}."""
        line = f"| `{name}` |"
        for column in self.columns:
            if column not in cells:
                line += " | | |"
                continue
            ours, theirs = cells[column]
            error = ours / theirs - 1
            line += f" {ours:.0f} | {theirs:.0f} | {f'{100 * error:+.1f} %' if comparable else 'not comparable'} |"
            if comparable:
                self.ratios[column].append(ours / theirs)
                if wrong := wrong_error(error, self.limit, self.known.get((name, column))):
                    self.wrong.append(f"{name}, {column}: {ours:.0f} cycles, the RTL {theirs:.0f}: {wrong}")
        print(line, flush=True)

    def mean(self):
        """Prints the last row; returns the geometric mean's error by column."""
        means = {c: math.exp(sum(map(math.log, r)) / len(r)) - 1 for c, r in self.ratios.items() if r}
        print(f"| {MEAN} |" + "".join(f" | | {100 * means[c]:+.1f} % |" for c in means))
        return means


def compare(run, references, known, named, errors):
    """Prints the tables of a file; returns what is wrong. \p errors: known_errors()."""
    wrong, names = [], []
    errors = {(row, column): error for (file, row, column), error in errors.items() if file == run.FILE}
    with tempfile.TemporaryDirectory() as folder:
        loops = Table("loop", f"Cycles of an iteration on `{PRESET}` beside the RTL, {run.WHAT}", run.LOOPS, OF_LOOP,
                      errors)
        for loop in known["loops"]:
            loop["assembly"] = placed(loop.get("assembly") or named[loop["name"]])
            loops.row(loop["name"], {column: (per_iteration(folder, references, run, loop, column), theirs)
                                     for column, theirs in loop["cycles_per_iteration"].items()}, loop["comparable"])
        loops.mean()
        whole = Table("kernel", f"Cycles of a whole kernel on `{PRESET}` beside the RTL, {run.WHAT}", run.KERNELS, OF_KERNEL,
                      errors)
        for kernel in known["kernels"]:
            program = program_of(folder, references, kernel["name"])
            if another := kernels.another_image(program, kernel):
                wrong.append(f"{kernel['name']}: {another}")
                continue
            cells = {}
            for column, theirs in kernel["cycles"].items():
                shape = run.of_kernel(column)
                time, result = kernels.ours(program, {"preset": PRESET, "warps": shape[1], "fixed_cycles": 0}, changes(run, shape))
                names.append(clocked.name(time))
                # Stores may still be on their way then.
                end = time["cycles"] - min(core["ended"] for core in time["cores"])
                cells[column] = (end, theirs - run.CLEARING)
                if result != kernel["result"]:
                    wrong.append(f"{kernel['name']}, {column}: result {result}, expected {kernel['result']}")
            whole.row(kernel["name"], cells)
        for column, error in whole.mean().items():
            if far := wrong_error(error, OF_MEAN, errors.get((MEAN, column))):
                wrong.append(f"kernels, {column}: {MEAN}: {far}")
        clocked.say(names)
    return loops.wrong + wrong + whole.wrong


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("references")
    parser.add_argument("--known", default=os.path.join(HERE, "vortex5_known.json"))
    args = parser.parse_args()
    references, errors = args.references, known_errors(args.known)
    with open(os.path.join(references, "vortex_core_cpi.json")) as file:
        named = {kernel["name"]: kernel["assembly"] for kernel in json.load(file)["kernels"]}
    wrong = []
    for run in (Warps, Cores):
        path = os.path.join(references, run.FILE)
        if not os.path.exists(path):
            continue
        with open(path) as file:
            wrong += compare(run, references, json.load(file), named, errors)
    for line in wrong:
        print(f"vortex5.py: error: {line}", file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    command_line.run(main)
