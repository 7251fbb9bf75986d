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
import draws  # noqa: E402
import energy  # noqa: E402
import identical  # noqa: E402
import invocations  # noqa: E402
import others  # noqa: E402
import rates  # noqa: E402
import runs  # noqa: E402
import scaling  # noqa: E402
import scenes  # noqa: E402
import speedup  # noqa: E402
import tails  # noqa: E402
import tiles  # noqa: E402
import training  # noqa: E402

SECTIONS = {"rates": rates, "choices": choices, "speedup": speedup, "clocks": clocks, "tails": tails, "depth": depth,
            "scaling": scaling, "tiles": tiles, "identical": identical, "energy": energy, "changes": changes, "training": training,
            "draws": draws, "others": others}
# What is measured unless --sections says otherwise: all but the hours of other documents.
DEFAULT = [name for name in SECTIONS if name != "others"]
# The scenes of the tables, which anybody can make, and after them the private ones, chosen before anything was measured, where
# they are beside the repository; and those that are drawn larger, too.
SCENES = ("object-100k", "outdoor-100k", "outdoor-1m")
PRIVATE = ("guitar", "truck", "garden_outdoor")
LARGE, LARGE_WIDTH = ("object-100k", "outdoor-100k", "guitar", "truck"), 1920
WITH_LARGE = (rates, speedup)


def parse_arguments():
    parser = argparse.ArgumentParser(prog="paper.sh", description=__doc__.split("\n\n")[0], epilog=__doc__.split("\n\n")[-1])
    parser.add_argument("--out", default=os.path.join(scenes.ROOT, "build", "paper"), metavar="FOLDER",
                        help="results (default build/paper)")
    parser.add_argument("--document", default=os.path.join(scenes.ROOT, "docs", "paper-results.md"), metavar="FILE",
                        help="what to write (default docs/paper-results.md); beside it a page a section in paper/, charts in images/")
    parser.add_argument("--scenes", nargs="+", metavar="NAME",
                        help=f"scenes of the benchmark set and of ../shared/data (default: {' '.join(SCENES)}, and where "
                        f"they are {' '.join(PRIVATE)}; section tails: {' '.join(tails.SCENES)}; section tiles: all)")
    parser.add_argument("--scene", nargs=2, metavar=("FILE", "CAMERAS"), help="any other scene instead")
    parser.add_argument("--large", nargs="*", default=LARGE, metavar="NAME",
                        help=f"those that sections rates and speedup draw {LARGE_WIDTH} pixels wide, too (default: {' '.join(LARGE)})")
    parser.add_argument("--captures", nargs="+", metavar="NAME",
                        help="captures of the benchmark set and of ../shared/data, or folders, that section training measures (default: "
                        f"{' '.join(training.DEFAULT_CAPTURES)})")
    parser.add_argument("--iterations", type=int, default=1050, metavar="N",
                        help="of training before those that section training measures (default 1050)")
    parser.add_argument("--sections", nargs="+", choices=SECTIONS, default=DEFAULT,
                        help="what to measure (default: all but others)")
    parser.add_argument("--widths", nargs="+", type=int, default=invocations.WIDTHS, metavar="PX",
                        help="picture widths of the counts")
    parser.add_argument("--draws", type=int, default=draws.COUNT, metavar="N", help=f"draws of section draws (default {draws.COUNT})")
    parser.add_argument("--draw-scenes", nargs="+", choices=scenes.PUBLIC, default=draws.SCENES, metavar="NAME",
                        help=f"scenes of the benchmark set that section draws draws (default: {' '.join(draws.SCENES)})")
    parser.add_argument("--draw-widths", nargs="+", type=int, default=(), metavar="PX", help="their picture widths (default: as they are)")
    parser.add_argument("--jobs", type=int, default=1, metavar="N", help="runs at a time (default 1)")
    parser.add_argument("--every-view", action="store_true",
                        help="try all twelve choices of the kernels on all views, not on two of each scene")
    parser.add_argument("--keep", action="store_true", help="take runs of other builds, too")
    parser.add_argument("--only-kept", action="store_true",
                        help="run nothing: write what there is, and leave out the rest")
    args = parser.parse_args()
    if args.jobs < 1 or args.iterations < 1 or args.draws < 3:
        parser.error(f"--jobs is {args.jobs}, --iterations {args.iterations} and --draws {args.draws}, expected at least 1, 1 and 3")
    return args


def chosen(args):
    """The scenes of the frames, those of section tails, and those of the counts."""
    if args.scene:
        one = [scenes.given(*args.scene)]
        return one, one, one
    known = (*scenes.PUBLIC, *scenes.known())
    unknown = [name for name in args.scenes or () if name not in known]
    if unknown:
        print(f"paper.sh: error: no scene {unknown[0]}, expected one of: {' '.join(known)}", file=sys.stderr)
        sys.exit(3)

    def named(names):
        return [scenes.named(name) for name in dict.fromkeys(names) if name in known]

    if args.scenes:
        return (named(args.scenes),) * 3
    frames = (*SCENES, *PRIVATE)
    return named(frames), named(tails.SCENES), named(known if "tiles" in args.sections else frames)


def larger(args, frames):
    """The same scenes in the larger size, as far as --large names them."""
    folder = os.path.join(args.out, "cameras")
    return [scenes.at_width(scene, LARGE_WIDTH, folder) for scene in frames if scene.name in args.large]


def drawn_scenes(args):
    """The scenes of section draws, each with the scene to whose size its figures are scaled."""
    if args.scene:
        return [(scenes.given(*args.scene), None)]
    targets = {kind: scenes.generated(f"{kind}-{draws.TARGET}") for kind in {name.split("-")[0] for name in args.draw_scenes}}
    return [(scenes.generated(name), targets[name.split("-")[0]]) for name in args.draw_scenes]


def captures_of(args):
    """The captures of section training; where none are named, those that are there."""
    names = args.captures or [name for name in training.DEFAULT_CAPTURES if not args.only_kept or training.is_written(name)]
    named = [training.Capture.named(name, args.out) for name in names]
    gone = [capture for capture in named if not capture.is_there()]
    if args.captures and gone:
        print(f"paper.sh: error: no capture {gone[0].path}, expected one of ../shared/data or a folder", file=sys.stderr)
        sys.exit(3)
    return [capture for capture in named if capture not in gone]


def main():
    args = parse_arguments()
    frames, tailed, counts = chosen(args) if set(args.sections) - {"training", "draws"} else ([], [], [])
    captures = captures_of(args) if "training" in args.sections else []
    large = larger(args, frames)
    store = runs.Runs(args.out, args.jobs, args.keep, args.only_kept)
    for name in args.sections:
        module = SECTIONS[name]
        store.begin_section()
        try:
            if module is tiles:
                data = module.measure(store, counts, args.every_view, tuple(args.widths))
            elif module is tails:
                data = module.measure(store, tailed, args.every_view)
            elif module is draws:
                data = module.measure(store, drawn_scenes(args), args.draw_widths, args.draws)
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
