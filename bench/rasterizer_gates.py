#!/usr/bin/env python3
"""Counts the gates of the rasterizer in SystemVerilog (test/rtl) with Yosys: docs/unification.md.

usage: bench/rasterizer_gates.py lanes|rasterizers|edges|backward|MODULE
lanes: a lane of each design; rasterizers: the whole of each, by part; edges: a lane's integer edges, by sub-pixel bits;
backward: a pair of lanes and the gather; MODULE: any module with its defaults, by module. A gate counts as the
transistors of static CMOS that Yosys' `stat -tech cmos` gives it, a flip-flop as 16, a bit of the pixel buffer as 6.
All other arrays are made of flip-flops.
Restating and dispatch are mapped with `abc -fast`, which gives up to a quarter more: without, they take minutes."""

import collections
import pathlib
import re
import subprocess
import sys
import tempfile

import command_line

RTL = pathlib.Path(__file__).resolve().parent.parent / "test/rtl"
SOURCES = "fp32 exp_table triangle lane cut pixel_bank dispatch fetch tile_writer rasterizer backward".split()
TRANSISTORS = {"NOT": 2, "AND": 6, "NAND": 4, "OR": 6, "NOR": 4, "XOR": 12, "XNOR": 12, "MUX": 12, "AOI3": 6, "OAI3": 6,
               "DFF_P": 16}
GATES = "AND,NAND,OR,NOR,XOR,XNOR,MUX,AOI3,OAI3"
BIT = 6  # transistors, of the pixel buffer
BANK_ROWS = 256

# GAUSSIANS, TRIANGLES, FP_EDGES of lane.sv and rasterizer.sv.
DESIGNS = {
    "Gaussians": (1, 0, 0),
    "triangles": (0, 1, 0),
    "triangles, edges in fp32": (0, 1, 1),
    "both": (1, 1, 0),
    "both, edges in fp32": (1, 1, 1),
}


# Bits of a step and of a value of edges whose corners have N sub-pixel bits: docs/primitives.md.
EDGES = {"any steps of 32 bits": (32, 40), **{f"{n} sub-pixel bits": (19 + n, 27 + n) for n in (8, 6, 4)}}


def designs_of(module):
    return [f"{module} #(.GAUSSIANS({g}), .TRIANGLES({t}), .FP_EDGES({f}))" for g, t, f in DESIGNS.values()]


def mapped(instances):
    """Cells by type of each module that these need; what they share is mapped once."""
    # Each in a module of its own, whose name says which it is.
    tops = "".join(f"module top_{n};\n  (* keep *) {i} it ();\nendmodule\n" for n, i in enumerate(instances))
    kept = "\n".join(f"  (* keep *) top_{n} counted_{n} ();" for n in range(len(instances)))
    with tempfile.TemporaryDirectory() as folder:
        top, out = pathlib.Path(folder) / "counted.sv", pathlib.Path(folder) / "stat"
        top.write_text(f"{tops}module counted;\n{kept}\nendmodule\n")
        sources = " ".join(str(RTL / f"{s}.sv") for s in SOURCES)
        script = f"""read_verilog -sv {sources} {top}
            hierarchy -check -top counted
            proc; opt; wreduce; opt; memory -nomap; memory_map * *pixel_bank* %d; opt
            techmap; opt_expr; opt_clean; dfflegalize -cell $_DFF_P_ 01; opt_expr; opt_clean
            abc -g {GATES} * *restate* dispatch %u %d
            abc -fast -g {GATES} *restate* dispatch
            opt_clean
            tee -q -o {out} stat"""
        run = subprocess.run(["yosys", "-q", "-p", script], capture_output=True, text=True)
        if run.returncode != 0:
            sys.exit("rasterizer_gates.py: error: yosys: " + (run.stderr or run.stdout).strip().splitlines()[-1])
        return cells(out.read_text())


def cells(text):
    modules = {}
    for part in re.split(r"^=== ", text, flags=re.M)[1:]:
        name = part.split(" ===")[0]
        if name != "design hierarchy":
            modules[name] = {kind: int(count) for kind, count in re.findall(r"^     (\S+) +(\d+)$", part, flags=re.M)}
    return modules


def short(module):
    """A module's name without its parameters."""
    return re.sub(r"^\$paramod(\$\w+)?\\(\w+).*", r"\2", module)


class Counts:
    def __init__(self, instances):
        self.modules = mapped(instances)
        self.tops = [next(iter(self.modules[f"top_{n}"])) for n in range(len(instances))]

    def inside(self, module):
        return {kind: count for kind, count in self.modules[module].items() if kind in self.modules}

    def own(self, module):
        """Transistors of a module's own gates."""
        total = 0
        for kind, count in self.modules[module].items():
            gate = kind[2:-1]
            if gate in TRANSISTORS:
                total += count * TRANSISTORS[gate]
            elif kind not in self.modules and not kind.startswith("$mem"):
                sys.exit(f"rasterizer_gates.py: error: {short(module)}: has a {kind}, expected gates and flip-flops")
        return total

    def all(self, module):
        return self.own(module) + sum(count * self.all(kind) for kind, count in self.inside(module).items())

    def bits(self, module):
        """Of the pixel buffer."""
        wide = re.search(r"pixel_bank.*BITS=\S*?'([01]+)", module)
        if short(module) == "pixel_bank":
            return BANK_ROWS * (int(wide[1], 2) if wide else 128)
        return sum(count * self.bits(kind) for kind, count in self.inside(module).items())

    def parts(self, module):
        """Transistors by part, and of all."""
        rows = collections.Counter()
        for kind, count in self.inside(module).items():
            rows[f"{count} {short(kind)}" if count > 1 else short(kind)] += count * self.all(kind)
        rows["own gates and flip-flops"] += self.own(module)
        if rows.total() != self.all(module):
            raise AssertionError(module)
        rows["all but the pixel buffer"] = self.all(module)
        if self.bits(module):
            rows["bits of the pixel buffer"] = BIT * self.bits(module)
            rows["all"] = self.all(module) + BIT * self.bits(module)
        return rows


def table(names, columns):
    rows = list(dict.fromkeys(row for column in columns for row in column))
    last = [r for r in ("all but the pixel buffer", "bits of the pixel buffer", "all") if r in rows]
    print("| transistors | " + " | ".join(names) + " |\n|---|" + "--:|" * len(names))
    for row in [r for r in rows if r not in last] + last:
        print(f"| {row} | " + " | ".join(f"{c[row]:,}" if row in c else "" for c in columns) + " |")


def tree(counts, module, depth=0, times=1):
    print(f"{'  ' * depth}{short(module)} x {times}: {counts.all(module):,}, own {counts.own(module):,}")
    for kind, count in sorted(counts.inside(module).items(), key=lambda p: -p[1] * counts.all(p[0])):
        tree(counts, kind, depth + 1, count)


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: bench/rasterizer_gates.py lanes|rasterizers|edges|backward|MODULE")
    what = sys.argv[1]
    if what in ("lanes", "rasterizers"):
        module = what[:-1]
        counts = Counts(designs_of(module))
        table(list(DESIGNS), [counts.parts(top) for top in counts.tops])
        return
    if what == "edges":
        counts = Counts([f"edges #(.STEP({step}), .SUM({value}))" for step, value in EDGES.values()])
        table(list(EDGES), [counts.parts(top) for top in counts.tops])
        return
    counts = Counts(["gradients", "gather"] if what == "backward" else [what])
    for top in counts.tops:
        tree(counts, top)


if __name__ == "__main__":
    command_line.run(main)
