#!/usr/bin/env python3
"""Measures what the paper says about rendering and training, and writes docs/paper-results.md and docs/paper/.

usage: scripts/paper.sh [OPTIONS]

Every run is kept in a file under --out and not repeated while programs, inputs and options are the same, so a run that
is broken off goes on where it stopped. Sections whose results are not there yet are named in the document as not measured.

exit codes: 0 done, 1 a run failed or two pictures differ that should not, 2 usage, 3 no scenes
"""

import argparse
import os
import sys

FOLDER = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.dirname(FOLDER))

import changes  # noqa: E402
import choices  # noqa: E402
import clocks  # noqa: E402
import depth  # noqa: E402
import document  # noqa: E402
import energy  # noqa: E402
import identical  # noqa: E402
import invocations  # noqa: E402
import rates  # noqa: E402
import runs  # noqa: E402
import scaling  # noqa: E402
import scenes  # noqa: E402
import speedup  # noqa: E402
import tails  # noqa: E402
import tiles  # noqa: E402
import training  # noqa: E402

SECTIONS = {"rates": rates, "choices": choices, "speedup": speedup, "clocks": clocks, "tails": tails, "depth": depth,
            "scaling": scaling, "tiles": tiles, "identical": identical, "energy": energy, "changes": changes, "training": training}
# The scenes of the tables, chosen before anything was measured, and those that are drawn larger, too.
SCENES = ("guitar", "truck", "garden_outdoor")
LARGE, LARGE_WIDTH = ("guitar", "truck"), 1920
WITH_LARGE = (rates, speedup)


def parse_arguments():
    parser = argparse.ArgumentParser(prog="paper.sh", description=__doc__.split("\n\n")[0], epilog=__doc__.split("\n\n")[-1])
    parser.add_argument("--out", default=os.path.join(scenes.ROOT, "build", "paper"), metavar="FOLDER",
                        help="results (default build/paper)")
    parser.add_argument("--document", default=os.path.join(scenes.ROOT, "docs", "paper-results.md"), metavar="FILE",
                        help="what to write (default docs/paper-results.md); beside it a page a section in paper/, charts in images/")
    parser.add_argument("--scenes", nargs="+", metavar="NAME",
                        help=f"scenes of ../shared/data (default: {' '.join(SCENES)}; section tails: "
                        f"{' '.join(tails.SCENES)}; section tiles: all)")
    parser.add_argument("--scene", nargs=2, metavar=("FILE", "CAMERAS"), help="any other scene instead")
    parser.add_argument("--large", nargs="*", default=LARGE, metavar="NAME",
                        help=f"those that sections rates and speedup draw {LARGE_WIDTH} pixels wide, too (default: {' '.join(LARGE)})")
    parser.add_argument("--captures", nargs="+", metavar="NAME",
                        help="captures of ../shared/data, or folders, that section training measures (default: "
                        f"{' '.join(training.DEFAULT_CAPTURES)})")
    parser.add_argument("--iterations", type=int, default=1050, metavar="N",
                        help="of training before those that section training measures (default 1050)")
    parser.add_argument("--sections", nargs="+", choices=SECTIONS, default=list(SECTIONS),
                        help="what to measure (default: all)")
    parser.add_argument("--widths", nargs="+", type=int, default=invocations.WIDTHS, metavar="PX",
                        help="picture widths of the counts")
    parser.add_argument("--jobs", type=int, default=1, metavar="N", help="runs at a time (default 1)")
    parser.add_argument("--every-view", action="store_true",
                        help="try all twelve choices of the kernels on all views, not on two of each scene")
    parser.add_argument("--keep", action="store_true", help="take runs of other builds, too")
    parser.add_argument("--only-kept", action="store_true",
                        help="run nothing: write what there is, and leave out the rest")
    args = parser.parse_args()
    if args.jobs < 1 or args.iterations < 1:
        parser.error(f"--jobs is {args.jobs} and --iterations {args.iterations}, expected at least 1")
    return args


def chosen(args):
    """The scenes of the frames and those of the counts."""
    if args.scene:
        one = [scenes.given(*args.scene)]
        return one, one
    known = scenes.known()
    unknown = [name for name in args.scenes or () if name not in known]
    if not known or unknown:
        print(f"paper.sh: error: no scene {unknown[0]} in ../shared/data, expected one of: {' '.join(known)}" if known else
              "paper.sh: error: no ../shared/data, expected scenes there, or --scene FILE CAMERAS", file=sys.stderr)
        sys.exit(3)
    return [scenes.shared(n) for n in args.scenes or SCENES], [scenes.shared(n) for n in args.scenes or known]


def larger(args, frames):
    """The same scenes in the larger size, as far as --large names them."""
    folder = os.path.join(args.out, "cameras")
    return [scenes.at_width(scene, LARGE_WIDTH, folder) for scene in frames if scene.name in args.large]


def captures_of(args):
    """The captures of section training; where none are named, those that are there."""
    named = [training.Capture.named(name, args.out) for name in args.captures or training.DEFAULT_CAPTURES]
    gone = [capture for capture in named if not capture.is_there()]
    if args.captures and gone:
        print(f"paper.sh: error: no capture {gone[0].path}, expected one of ../shared/data or a folder", file=sys.stderr)
        sys.exit(3)
    return [capture for capture in named if capture not in gone]


def main():
    args = parse_arguments()
    frames, counts = chosen(args) if set(args.sections) - {"training"} else ([], [])
    captures = captures_of(args) if "training" in args.sections else []
    large = larger(args, frames)
    store = runs.Runs(args.out, args.jobs, args.keep, args.only_kept)
    for name in args.sections:
        module = SECTIONS[name]
        store.begin_section()
        try:
            if module is tiles:
                data = module.measure(store, counts, args.every_view, tuple(args.widths))
            elif module is tails and not (args.scenes or args.scene):
                data = module.measure(store, [scenes.shared(name) for name in tails.SCENES], args.every_view)
            elif module is training:
                data = module.measure(store, captures, args.every_view, args.iterations)
            else:
                data = module.measure(store, frames + large * (module in WITH_LARGE), args.every_view)
        except runs.Missing as missing:
            print(f"section {name} left out: {missing}", file=sys.stderr)
            continue
        if args.only_kept and not (data.get("rows") or data.get("sweeps")):
            continue
        data.update(builds=sorted(store.builds), clocks=sorted(store.clocks), left_out=list(dict.fromkeys(store.left_out)),
                    seconds=store.seconds)
        store.write(name, data)
    document.write(args.document, {name: (module, store.read(name)) for name, module in SECTIONS.items()})
    same = store.read("identical")
    if same and not identical.same(same):
        print("paper.sh: error: pictures or times differ, expected the same for every way to run them", file=sys.stderr)
        sys.exit(1)


if __name__ == "__main__":
    try:
        main()
    except runs.Failed as error:
        print(f"paper.sh: error: {error}", file=sys.stderr)
        sys.exit(1)
