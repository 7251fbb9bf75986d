#!/usr/bin/env python3
"""What each part of the compiler's backend, and each extension that it compiles for, is worth: frames drawn with that alone
switched off.

usage: compiler_parts.py --out FOLDER [--machines NAME,...] [--views all|SCENE:VIEW:PATH,...] [--samples PROGRAM,...] [--parts NAME,...]
                         [--frames]

Draws each view on each machine with the whole backend, and again with one part off; runs the samples, which check their
results, in the same way. Each run compiles its kernels anew; options of vorion-clang reach it by VORION_REMARKS. All
pictures of a view must have the same bits. Prints tables of Markdown: the code and the warp instructions of `project`, and on
the path simt of `blend`, and what a part's absence adds to the cycles of frames, of these kernels and of samples; with
--frames a table of frames alone, a view a line. --views all draws every view of ../shared/data on both paths. FOLDER
keeps each run's result (docs/studies.md). Exit codes: 0, 1 a picture differs.
"""

import argparse
import sys

import clocked
import command_line
import scenes
import study
from kernels import functions, resources_to

# Beyond rv32imaf and what the machine is made of (docs/abi.md).
EXTENSIONS = ("zicond", "zba", "zbb", "zbs")


def target_without(*absent):
    present = [name for name in EXTENSIONS if name not in absent]
    return "-march=" + "_".join(["rv32imaf_zicsr_zacas", *present, "xvortex_xvorion"])


# vorion-clang's options for each part: all of the backend's own, LLVM's scheduler, which is run twice and reads our model, and
# the extensions.
PARTS = {
    "none": "",
    "second scheduling": "-mllvm -enable-post-misched=false",
    "first scheduling": "-mllvm -enable-misched=false",
    "model of latencies": "-mllvm -schedmodel=false",
    "float constants": "-mllvm -vorion-float-constants=false",
    "places of constants": "-mllvm -vorion-place-constants=false",
    "raised invariants": "-mllvm -vorion-raise-invariants=false",
    "selects": "-mllvm -vorion-select-sides=false",
    "uniform tests": "-mllvm -vorion-uniform-tests=false",
    "rounds of passes": "-mllvm -vorion-round-limit=0",
}
# What LLVM would do alone with the lowering of divergent branches that the machine needs.
PARTS["all of these"] = " ".join(option for part, option in PARTS.items() if part != "first scheduling" and option)
PARTS |= {
    **{name.capitalize(): target_without(name) for name in EXTENSIONS},
    "all four extensions": target_without(*EXTENSIONS),
}
MACHINES = "prototype,prototype-forwarding,scaled"
VIEWS = "guitar:front:raster,truck:overview:raster,garden_outdoor:path:raster,guitar:front:simt"
SAMPLES = "sample-vecadd,sample-matmul,sample-scan,sample-radixsort"


def kernels_of(path):
    return ("project", "blend") if path == "simt" else ("project",)


def point(machine, part, name, command, options="", inputs=None, keep=(), **variables):
    """A run with one part off, whose kernels are compiled anew."""
    return study.Point("-".join((machine, part.replace(" ", "_"), name)), command, inputs or {},
                       {"VORION_CONFIG": machine, "VORION_REMARKS": f"{PARTS[part]} {options}", "POCL_CACHE_DIR": "{out}.cache", **variables}, keep)


def drawn(out, machine, parts, view):
    """What a frame takes with each part off, and the hash of its picture."""
    scene, name, path = view.split(":")
    of = scenes.shared(scene)
    command = study.render("", of, name, "--path", path, "--time").command
    points = [point(machine, part, view.replace(":", "-"), command, resources_to("{out}.resources"),
                    {"scene": of.path, "cameras": of.cameras}, (".resources",)) for part in parts]
    return {part: frame(result["report"], functions(study.file_of(out, one, ".resources")), path)
            for part, one, result in zip(parts, points, study.measure(points, out), strict=True)}


def frame(said, code, path):
    row = {"machine": clocked.name(said["time"]["sum"]), "picture": said["result_fnv1a64"], "cycles": {"frame": said["time"]["sum"]["cycles"]},
           "instructions": {"frame": said["total"]["counters"]["warp_instructions"]}}
    for stage in said["time"]["stages"]:
        if stage["name"] in kernels_of(path):
            row["cycles"][stage["name"]] = stage["time"]["cycles"]
    for stage in said["stages"]:
        for kernel in stage["kernels"]:
            if kernel["name"] in kernels_of(path):
                row["instructions"][kernel["name"]] = kernel["counters"]["warp_instructions"]
    row["code"] = {name: {"bytes": code[name]["code_bytes"],
                          "spilling": code[name]["spills"]["stores"] + code[name]["spills"]["loads"]}
                   for name in kernels_of(path)}
    return row


def sampled(out, machine, parts, program):
    """What a sample takes with each part off; its exit code says whether its results are right."""
    points = [point(machine, part, program, (program,), VORION_TIME="1", VORION_STATS="{out}.json") for part in parts]
    reports = [result["report"] for result in study.measure(points, out)]
    return {part: {"machine": clocked.name(said["runs"][0]["time"]), "cycles": {"all kernels": sum(run["time"]["cycles"] for run in said["runs"])},
                   "instructions": {"all kernels": said["total"]["warp_instructions"]}} for part, said in zip(parts, reports, strict=True)}


def change(now, before):
    """In per cent; 0.0 where they are equal to the digit."""
    percent = f"{100 * (now / before - 1):+.1f}"
    return "0.0" if percent in ("+0.0", "-0.0") else percent


def print_table(headings, rows):
    print("\n|" + "|".join(f" {heading} " for heading in headings) + "|")
    print("|---|" + "--:|" * (len(headings) - 1))
    for row in rows:
        print("|" + "|".join(f" {cell} " for cell in row) + "|")


def code_table(rows, kernel, view, parts):
    headings = ["part off", "bytes of code", "spills and reloads", "warp instructions", "change, %"]
    whole = rows["none"]
    print(f"\n`{kernel}` of {view.replace(':', ' ')}:")
    print_table(headings, [[part, f"{rows[part]['code'][kernel]['bytes']:,}", rows[part]["code"][kernel]["spilling"],
                            f"{rows[part]['instructions'][kernel]:,}",
                            change(rows[part]["instructions"][kernel], whole["instructions"][kernel])] for part in parts])


def cycles_table(found, machine, columns, parts):
    """The first row is what the whole backend gives."""
    whole = [found[machine, ran]["none"]["cycles"][what] for ran, what in columns]
    print(f"\nCycles on `{machine}`; the first row has millions, the others changes in %:")
    print_table(["part off"] + [f"{ran.replace(':', ' ')}: {what}" for ran, what in columns],
                [[part] + [f"{was / 1e6:.3f}" if part == "none" else change(found[machine, ran][part]["cycles"][what], was)
                           for (ran, what), was in zip(columns, whole)] for part in parts])
    clocked.say(found[machine, ran][part]["machine"] for ran, _ in columns for part in parts)


def frames_table(found, machines, views, parts):
    """Millions of cycles with the whole backend, and what parts' absence adds in %."""
    others = [part for part in parts if part != "none"]
    print("\nMillions of cycles of frames, and what is added in % where a part is off:")
    print_table(["frame"] + [cell for machine in machines for cell in (machine, *others)],
                [[view.replace(":", " ")] + [cell for machine in machines for rows in [found[machine, view]] for cell in (
                    f"{rows['none']['cycles']['frame'] / 1e6:.3f}",
                    *(change(rows[part]["cycles"]["frame"], rows["none"]["cycles"]["frame"]) for part in others))]
                 for view in views])
    clocked.say(rows["none"]["machine"] for rows in found.values())


def all_views():
    return [":".join((name, view, path)) for path in ("raster", "simt")
            for name in sorted(scenes.known(), key=lambda name: scenes.size(scenes.shared(name)))
            for view in scenes.shared(name).views]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", required=True)
    parser.add_argument("--machines", default=MACHINES)
    parser.add_argument("--views", default=VIEWS, help="none if empty; all: every view of every scene on both paths")
    parser.add_argument("--frames", action="store_true", help="print one table of frames")
    parser.add_argument("--samples", default=SAMPLES, help="programs; none if empty")
    parser.add_argument("--parts", default=",".join(PARTS))
    args = parser.parse_args()
    machines = args.machines.split(",")
    views, samples = ([name for name in given.split(",") if name] for given in (args.views, args.samples))
    if args.views == "all":
        views = all_views()
    parts = ["none"] + [part for part in args.parts.split(",") if part != "none"]
    for part in parts:
        if part not in PARTS:
            parser.error(f"{part}: no such part, expected some of {', '.join(PARTS)}")
    found, code = {}, 0
    for view in views:
        for machine in machines:
            rows = drawn(args.out, machine, parts, view)
            found[machine, view] = rows
            for part in parts:
                if rows[part]["picture"] != found[machines[0], view]["none"]["picture"]:
                    print(f"compiler_parts.py: error: {view} on {machine} without {part}: the picture has other bits, expected the same",
                          file=sys.stderr)
                    code = 1
    if args.frames:
        frames_table(found, machines, views, parts)
    for view in views if not args.frames else []:
        for kernel in kernels_of(view.split(":")[2]):
            code_table(found[machines[0], view], kernel, view, parts)
    for machine in machines:
        if views and not args.frames:
            cycles_table(found, machine, [(view, what) for view in views for what in ("frame", *kernels_of(view.split(":")[2]))], parts)
    ran = {(machine, sample): sampled(args.out, machine, parts, sample)
           for sample in samples for machine in machines}
    for machine in machines:
        if samples:
            cycles_table(ran, machine, [(sample, "all kernels") for sample in samples], parts)
    if found:
        same = "some with other bits" if code else "each view with the same bits"
        print(f"\n{len(found) * len(parts)} pictures of {len(views)} views, {same}")
    return code


if __name__ == "__main__":
    command_line.run(main)
