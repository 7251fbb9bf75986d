#!/usr/bin/env python3
"""What accuracy there is on real scenes (what it costs: docs/accuracy.md).

usage: accuracy.py pictures|fixtures|gradients [--data DIR] [--out DIR] [options]

pictures  every view, path and support of room7k_sh3 and box_sh3 against the
          fp64 reference, the two paths against each other, and the sorted
          pairs against the reference run in fp32
fixtures  the independent fp64 results of DATA/reference
gradients  the same fixtures' gradients and hand-over sums, by path and, with
          --units, by reciprocal unit and order of the sums

Prints a Markdown table and writes OUT/<mode>.json. Every row is kept as a file
below OUT, so that a broken run goes on where it stopped; rows that were made
from other programs or data are named and made again. Exit codes: 0 all rows within the bounds, 1 some are not, 3 no data.
The tools (splat, splat-reference, ...) are taken from the PATH: . scripts/env.sh
"""

import argparse
import json
import os
import shutil
import subprocess
import sys
import time

import command_line
import kept

# What makes results beside splat's programs.
TOOLS = {name: shutil.which(name) for name in ("splat-reference", "splat-fixture", "splat-check-gradients")
         if shutil.which(name)}
SCENES = ("room7k_sh3", "box_sh3")
VIEWS = ("front", "close", "far")
SUPPORTS = {"simt": ("exact", "box3", "square3", "official16"), "raster": ("exact", "box3", "square3")}
ALL_DB, SURE_DB, PATHS_DB = 60, 90, 100  # bounds on PSNR, peak 1, linear floats
MAX_DOUBTFUL, MAX_DOUBTFUL_HARD = 0.005, 0.02  # share of doubtful pixels


class Bench:
    def __init__(self, args):
        self.data, self.out = args.data, args.out
        os.makedirs(self.out, exist_ok=True)

    def path(self, name):
        return os.path.join(self.out, name)

    def run(self, *command):
        begin = time.monotonic()
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        if done.returncode:
            raise RuntimeError(f"{' '.join(command)}: exit code {done.returncode}: {done.stderr.strip()[-400:]}")
        return time.monotonic() - begin

    def once(self, name, inputs, make):
        """The JSON file `name` below OUT; make() returns it the first time, from files and folders by what they are."""
        return kept.result(self.path(name + ".row.json"), kept.origin({**TOOLS, **inputs}, [name]), make)

    def make(self, file, inputs, *command):
        """File below OUT made by command, which ends in the file's name."""
        made_from = kept.origin({**TOOLS, **inputs}, command)
        kept.once([self.path(file)], made_from, lambda: self.run(*command, self.path(file)))
        return self.path(file)

    def compare(self, expected, actual, mask, name):
        out = self.path(name + ".cmp.json")
        self.run("splat", "compare", expected, actual, "--mask", mask, "--json", out)
        with open(out) as f:
            return json.load(f)


def db(value):
    return "equal" if value is None else f"{value:.1f}"


def reached(value, bound):
    """PSNR against a bound; None stands for no difference at all."""
    return value is None or value >= bound


def decibels(result, where=""):
    """A PSNR of `splat compare`: None for no difference, and minus infinity where values are no finite numbers."""
    if result["not_finite" + where]:
        return float("-inf")
    return result["psnr_db" + where]


def pictures(bench, args):
    rows = []
    for scene in args.scenes.split(","):
        for view in args.views.split(","):
            ply = os.path.join(bench.data, "scenes", scene + ".ply")
            cameras = os.path.join(bench.data, "scenes", "cameras", scene + ".json")
            source = (ply, "--cameras", cameras, "--view", view)
            inputs = {"scene": os.path.abspath(ply), "cameras": os.path.abspath(cameras)}
            for support in SUPPORTS["simt"]:
                name = f"{scene}-{view}-{support}"
                reference = bench.make(f"{name}-f64.npz", inputs, "splat-reference", *source, "--support", support, "-o")
                made = {}
                for path in (p for p in SUPPORTS if support in SUPPORTS[p]):
                    def row(path=path):
                        base = f"{name}-{path}"
                        picture, report = bench.path(base + ".npz"), bench.path(base + ".json")
                        pairs = bench.path(base + "-pairs.npz")
                        wall = bench.run("splat", "render", *source, "--support", support, "--path", path,
                                         "-o", picture, "--json", report, "--dump-pairs", pairs)
                        tile = "64" if path == "raster" else "16"
                        wanted = bench.make(f"{name}-pairs{tile}.npz", inputs, "splat-reference", *source, "--support", support,
                                            "--precision", "f32", "--tile", tile, "--pairs")
                        same = subprocess.run(("splat", "compare", wanted, pairs, "--pairs"), capture_output=True,
                                              text=True)
                        result = bench.compare(reference, picture, reference, base)
                        with open(report) as f:
                            told = json.load(f)
                        return {"scene": scene, "view": view, "support": support, "path": path, "wall_s": wall,
                                "all_db": decibels(result), "sure_db": decibels(result, "_outside_doubtful"),
                                "doubtful": result["doubtful_share"], "pairs_equal": same.returncode == 0,
                                "pairs_said": (same.stdout or same.stderr).strip(), "report": told}
                    made[path] = bench.once(f"{name}-{path}", inputs, row)
                    rows.append(made[path])
                if len(made) == 2:
                    between = bench.once(f"{name}-paths", inputs, lambda: bench.compare(
                        bench.path(f"{name}-simt.npz"), bench.path(f"{name}-raster.npz"), reference, f"{name}-paths"))
                    made["raster"]["paths_db"] = decibels(between, "_outside_doubtful")
    print("| scene | view | support | path | all, dB | sure, dB | doubtful, % | paths, dB | pairs = fp32 | wall, s |")
    print("|---|---|---|---|---|---|---|---|---|---|")
    good = True
    for r in rows:
        row_good = (reached(r["all_db"], ALL_DB) and reached(r["sure_db"], SURE_DB)
                    and reached(r.get("paths_db"), PATHS_DB) and r["pairs_equal"] and r["doubtful"] <= MAX_DOUBTFUL)
        good &= row_good
        print(f"| {r['scene']} | {r['view']} | {r['support']} | {r['path']} | {db(r['all_db'])} | {db(r['sure_db'])} "
              f"| {100 * r['doubtful']:.3f} | {db(r['paths_db']) if 'paths_db' in r else ''} "
              f"| {'yes' if r['pairs_equal'] else 'NO'} | {r['wall_s']:.1f} |{'' if row_good else ' OUT OF BOUNDS'}")
    return rows, good


def fixture_names(bench):
    return sorted(n[:-4] for n in os.listdir(os.path.join(bench.data, "reference"))
                  if n.endswith(".npz") and not n.endswith("_more.npz"))


def fixture_of(bench, name):
    """The file of a fixture, as what a result is made from."""
    return {"fixture": os.path.abspath(os.path.join(bench.data, "reference", name + ".npz"))}


def converted(bench, name):
    """The folder of fixture `name` as splat reads it, and its options."""
    folder = bench.path(name)
    bench.once(name + "-fixture", fixture_of(bench, name), lambda: bench.run(
        "splat-fixture", os.path.join(bench.data, "reference", name + ".npz"), "-o", folder))
    with open(os.path.join(folder, "options.json")) as f:
        return folder, json.load(f)


def fixture_flags(folder, options):
    flags = [os.path.join(folder, "scene.ply"), "--cameras", os.path.join(folder, "cameras.json"), "--view", "view",
             "--rules", options["rules"], "--support", options["support"], "--dilation", str(options["dilation"]),
             "--background", ",".join(str(b) for b in options["background"])]
    return flags + (["--antialiased"] if options["antialiased"] else [])


def fixtures(bench, args):
    names = fixture_names(bench)
    wanted = ("random2k_sh3", "garden_crop192x144", "guitar256")
    rows = []
    for name in names:
        required = name in wanted or name.startswith("inria_")
        if not required and not args.hard:
            continue
        folder, options = converted(bench, name)
        for path in ("simt", "raster"):
            def row(path=path):
                picture = os.path.join(folder, path + ".npz")
                command = ["splat", "render", *fixture_flags(folder, options), "--path", path, "-o", picture]
                bench.run(*command)
                mask = os.path.join(folder, "reference.npz")
                result = bench.compare(os.path.join(folder, "expected.npz"), picture, mask, f"{name}-{path}")
                return {"fixture": name, "path": path, "rules": options["rules"], "support": options["support"],
                        "all_db": decibels(result), "sure_db": decibels(result, "_outside_doubtful"),
                        "doubtful": result["doubtful_share"], "required": required,
                        "conversion_db": options["conversion_db_outside_doubtful"]}
            rows.append(bench.once(f"{name}-{path}", fixture_of(bench, name), row))
    print("| fixture | rules | support | path | all, dB | sure, dB | doubtful, % | the conversion alone, dB |")
    print("|---|---|---|---|---|---|---|---|")
    good = True
    for r in rows:
        row_good = reached(r["sure_db"], SURE_DB) and r["doubtful"] <= MAX_DOUBTFUL_HARD
        good &= row_good or not r["required"]
        print(f"| {r['fixture']} | {r['rules']} | {r['support']} | {r['path']} | {db(r['all_db'])} "
              f"| {db(r['sure_db'])} | {100 * r['doubtful']:.3f} | {db(r['conversion_db'])} |"
              f"{'' if row_good else ' OUT OF BOUNDS'}")
    return rows, good


def error_of(array):
    return float("inf") if array["error"] is None else array["error"]


UNITS = ("exact", "even-left", "even-best", "log-left", "log-best", "mantissa-2", "mantissa-3")


def gradients(bench, args):
    variants = [("simt", "exact", "tree"), ("raster", "exact", "tree")]
    if args.units:
        variants += [("raster", unit, "tree") for unit in UNITS[1:]] + [("raster", "exact", "rows")]
    rows = []
    for name in fixture_names(bench):
        if name.startswith("hard_") and not args.hard:
            continue
        folder, options = converted(bench, name)
        for path, unit, order in variants:
            def row(path=path, unit=unit, order=order):
                base = os.path.join(folder, f"gradients-{path}-{unit}-{order}")
                choice = ["--reciprocal", unit, "--sum", order] if path == "raster" else []
                wall = bench.run("splat", "gradients", *fixture_flags(folder, options), "--path", path, *choice,
                                 "--upstream", os.path.join(folder, "upstream.npz"), "-o", base + ".npz")
                subprocess.run(("splat-check-gradients", os.path.join(folder, "gradients.npz"), base + ".npz", "--json",
                                base + ".json"), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
                with open(base + ".json") as f:
                    return {"fixture": name, "path": path, "reciprocal": unit, "sum": order, "rules": options["rules"],
                            "wall_s": wall, "arrays": json.load(f)}
            rows.append(bench.once(f"{name}-gradients-{path}-{unit}-{order}", fixture_of(bench, name), row))
    print("Relative L2 difference from fp64 (the largest, and of which array); beyond: arrays above 1e-5 and above twice the\n"
          "fixture's own fp32 error\n")
    print("| fixture | path | reciprocal | sum | largest error | of | beyond | wall, s |")
    print("|---|---|---|---|---|---|---|---|")
    good = True
    for r in rows:
        worst = max(r["arrays"], key=lambda a: error_of(r["arrays"][a]))
        # JSON has no NaN: an error that is one is null.
        beyond = [a for a, v in r["arrays"].items() if v["error"] is None or not v["error"] <= v["limit"]]
        good &= not beyond or r["reciprocal"] not in ("exact", "mantissa-3")
        print(f"| {r['fixture']} | {r['path']} | {r['reciprocal']} | {r['sum']} | {error_of(r['arrays'][worst]):.1e} "
              f"| {worst[4:]} | {' '.join(b[4:] for b in beyond)} | {r['wall_s']:.1f} |")
    return rows, good


def main():
    root = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mode", choices=("pictures", "fixtures", "gradients"))
    parser.add_argument("--data", default=os.path.join(root, "..", "shared", "data"))
    parser.add_argument("--out", default=os.path.join(root, "build", "accuracy"))
    parser.add_argument("--scenes", default=",".join(SCENES))
    parser.add_argument("--views", default=",".join(VIEWS))
    parser.add_argument("--hard", action="store_true", help="fixtures, gradients: the hard ones too")
    parser.add_argument("--units", action="store_true", help="gradients: every reciprocal unit and order of sums")
    args = parser.parse_args()
    if not os.path.isdir(args.data):
        print(f"accuracy.py: error: {args.data}: no such folder, expected the data with scenes/ and reference/",
              file=sys.stderr)
        return 3
    bench = Bench(args)
    try:
        modes = {"pictures": pictures, "fixtures": fixtures, "gradients": gradients}
        rows, good = modes[args.mode](bench, args)
    except RuntimeError as error:
        print(f"accuracy.py: error: {error}", file=sys.stderr)
        return 1
    with open(bench.path(args.mode + ".json"), "w") as f:
        json.dump(rows, f, indent=1)
    return 0 if good else 1


if __name__ == "__main__":
    command_line.run(main)
