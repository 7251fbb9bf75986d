#!/usr/bin/env python3
"""Several warps of `vortex-5stage` beside Vortex's RTL of May 2023, loops and whole kernels, as Markdown tables.

usage: warps.py REFERENCES

REFERENCES is a folder with vortex5_warps.json, vortex_core_cpi.json and vortex5_kernels/. A loop's number is the
difference of two runs divided by that of their iterations. A kernel's is the whole run, without the 256 cycles in which
the RTL's caches clear their lines; both ran the same image of memory.

exit codes: 0 all comparable loops within 5 %, kernels within 10 % and their geometric mean within 3 %, 1 not so, 2 usage
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

OF_LOOP, OF_KERNEL, OF_MEAN = 0.05, 0.10, 0.03
WARPS = ("1", "2", "4")
PRESET = "vortex-5stage"
# The caches of vortex5_warps.json; memory answers after 50 cycles, and 9 more for the queues on the way.
CHANGES = ("timing.socket.icache_kib=16", "timing.socket.icache_ways=1", "timing.core.interleaved_stacks=0",
           "timing.l2.fixed_cycles=59")
CLEARING = 256
# Where local memory is, and how lanes share its banks.
PLACES = {"LOCAL_BASE": "0xffff0000", "LANE_SHIFT": "2", "WORD_SHIFT": "6"}


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


def linked(folder, references, name):
    """The program of a kernel."""
    here, own = kernels.HERE, os.path.join(references, "vortex5_kernels")
    sources = [os.path.join(here, "start.s"), os.path.join(here, "compiled", name + ".s"), os.path.join(here, "inputs.s")]
    if name.startswith("own_"):
        sources = [os.path.join(own, part) for part in ("start.s", name + ".s", "inputs.s")]
    return kernels.linked([kernels.assembled(folder, placed_copy(folder, source)) for source in sources],
                          os.path.join(folder, name + ".elf"))


class Table:
    """Rows of a name and, for each number of warps, our cycles, the RTL's and the error."""

    def __init__(self, program, what, limit):
        self.limit, self.wrong = limit, []
        self.ratios = {warps: [] for warps in WARPS}
        print(f"\n{what} on `{PRESET}` beside the RTL, 1, 2 and 4 warps:\n")
        print(f"| {program} |" + " ours | RTL | error |" * len(WARPS))
        print("|---|" + "--:|--:|--:|" * len(WARPS))

    def row(self, name, cells, comparable=True):
        """\p cells: {warps: (ours, the RTL's)}."""
        line = f"| `{name}` |"
        for warps in WARPS:
            if warps not in cells:
                line += " | | |"
                continue
            ours, theirs = cells[warps]
            error = ours / theirs - 1
            line += f" {ours:.0f} | {theirs:.0f} | {f'{100 * error:+.1f} %' if comparable else 'not comparable'} |"
            if comparable:
                self.ratios[warps].append(ours / theirs)
                if abs(error) > self.limit:
                    self.wrong.append(f"{name}, {warps} warps: {ours:.0f} cycles, expected {theirs:.0f} within "
                                      f"{100 * self.limit:.0f} %")
        print(line, flush=True)

    def mean(self):
        """Prints the last row; returns the geometric mean's error by number of warps."""
        means = {w: math.exp(sum(map(math.log, r)) / len(r)) - 1 for w, r in self.ratios.items() if r}
        print("| geometric mean |" + "".join(f" | | {100 * means[w]:+.1f} % |" for w in means))
        return means


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("references")
    references = parser.parse_args().references
    with open(os.path.join(references, "vortex5_warps.json")) as file:
        known = json.load(file)
    with open(os.path.join(references, "vortex_core_cpi.json")) as file:
        named = {kernel["name"]: kernel["assembly"] for kernel in json.load(file)["kernels"]}
    with tempfile.TemporaryDirectory() as folder:
        loops = Table("loop", "Cycles of an iteration", OF_LOOP)
        for loop in known["loops"]:
            loop["assembly"] = placed(loop.get("assembly") or named[loop["name"]])
            loops.row(loop["name"],
                      {w: (cores.per_iteration(folder, loop, PRESET, int(w), CHANGES)[0], theirs)
                       for w, theirs in loop["cycles_per_iteration"].items()}, loop["comparable"])
        loops.mean()
        whole = Table("kernel", "Cycles of a whole kernel", OF_KERNEL)
        wrong, names = loops.wrong, []
        for kernel in known["kernels"]:
            program = linked(folder, references, kernel["name"])
            if another := kernels.another_image(program, kernel):
                wrong.append(f"{kernel['name']}: {another}")
                continue
            cells = {}
            for warps, theirs in kernel["cycles"].items():
                time, result = kernels.ours(program, {"preset": PRESET, "warps": int(warps), "fixed_cycles": 59}, CHANGES)
                names.append(clocked.name(time))
                cells[warps] = (time["cycles"], theirs - CLEARING)
                if result != kernel["result"]:
                    wrong.append(f"{kernel['name']}, {warps} warps: result {result}, expected {kernel['result']}")
            whole.row(kernel["name"], cells)
        for warps, error in whole.mean().items():
            if abs(error) > OF_MEAN:
                wrong.append(f"kernels, {warps} warps: geometric mean {100 * error:+.1f} %, expected 0 within "
                             f"{100 * OF_MEAN:.0f} %")
        clocked.say(names)
    for line in wrong + whole.wrong:
        print(f"warps.py: error: {line}", file=sys.stderr)
    return 1 if wrong + whole.wrong else 0


if __name__ == "__main__":
    command_line.run(main)
