#!/usr/bin/env python3
"""What accuracy there is on real scenes (what it costs: docs/accuracy.md).

usage: accuracy.py pictures|fixtures|gradients [--data DIR] [--out DIR] [options]

pictures  every view, path and support of room7k_sh3 and box_sh3 against the
          fp64 reference, the two paths against each other, and the sorted
          pairs against the reference run in fp32
fixtures  the independent fp64 results of DATA/reference
gradients  the same fixtures' gradients and hand-over sums, by path and, with
          --units, by reciprocal unit and order of the sums

Prints a Markdown table and writes OUT/<mode>.json. OUT keeps each run's result
(docs/studies.md). Exit codes: 0 all rows within the bounds, 1 some are not, 3 no data.
The tools (splat, splat-reference, ...) are taken from the PATH: . scripts/env.sh
"""

import argparse
import json
import os
import subprocess
import sys

import command_line
import study

SCENES = ("room7k_sh3", "box_sh3")
VIEWS = ("front", "close", "far")
SUPPORTS = {"simt": ("exact", "box3", "square3", "official16"), "raster": ("exact", "box3", "square3")}
ALL_DB, SURE_DB, PATHS_DB = 60, 90, 100  # bounds on PSNR, peak 1, linear floats
MAX_DOUBTFUL, MAX_DOUBTFUL_HARD = 0.005, 0.02  # share of doubtful pixels


class Bench:
    def __init__(self, args):
        self.data, self.out = os.path.abspath(args.data), os.path.abspath(args.out)

    def path(self, name):
        return os.path.join(self.out, name)

    def run(self, name, inputs, *command, keep=()):
        """The result of a command, whose words have its inputs' names, and the files that it leaves."""
        point = study.Point(name, command, inputs, keep=keep)
        result, = study.measure([point], self.out)
        return result, *(study.file_of(self.out, point, ending) for ending in keep)

    def compare(self, name, expected, actual, mask):
        inputs = {"expected": expected, "actual": actual, "mask": mask}
        result, = self.run(name, inputs, "splat", "compare", "{expected}", "{actual}", "--mask", "{mask}", "--json", "{out}.json")
        return result["report"]


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
            source = ("{scene}", "--cameras", "{cameras}", "--view", view)
            inputs = {"scene": ply, "cameras": cameras}
            for support in SUPPORTS["simt"]:
                name = f"{scene}-{view}-{support}"
                _, reference = bench.run(f"{name}-f64", inputs, "splat-reference", *source, "--support", support, "-o", "{out}.npz",
                                         keep=(".npz",))
                drawn = {}
                for path in (p for p in SUPPORTS if support in SUPPORTS[p]):
                    result, picture, pairs = bench.run(
                        f"{name}-{path}", inputs, "splat", "render", *source, "--support", support, "--path", path, "-o", "{out}.npz",
                        "--json", "{out}.json", "--pairs", "{out}-pairs.npz", keep=(".npz", "-pairs.npz"))
                    tile = "64" if path == "raster" else "16"
                    _, wanted = bench.run(f"{name}-pairs{tile}", inputs, "splat-reference", *source, "--support", support, "--precision",
                                          "f32", "--tile", tile, "--pairs", "{out}.npz", keep=(".npz",))
                    same = subprocess.run(("splat", "compare", wanted, pairs, "--pairs"), capture_output=True, text=True)
                    compared = bench.compare(f"{name}-{path}-compared", reference, picture, reference)
                    rows.append({"scene": scene, "view": view, "support": support, "path": path, "wall_s": result["seconds"],
                                 "all_db": decibels(compared), "sure_db": decibels(compared, "_outside_doubtful"),
                                 "doubtful": compared["doubtful_share"], "pairs_equal": same.returncode == 0,
                                 "pairs_said": (same.stdout or same.stderr).strip(), "report": result["report"]})
                    drawn[path] = picture
                if len(drawn) == 2:
                    between = bench.compare(f"{name}-paths", drawn["simt"], drawn["raster"], reference)
                    rows[-1]["paths_db"] = decibels(between, "_outside_doubtful")
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


def converted(bench, name):
    """The folder of fixture `name` as splat reads it, and its options."""
    fixture = os.path.join(bench.data, "reference", name + ".npz")
    _, folder = bench.run(name, {"fixture": fixture}, "splat-fixture", "{fixture}", "-o", "{out}.fixture", keep=(".fixture",))
    with open(os.path.join(folder, "options.json")) as f:
        return folder, json.load(f)


def fixture_flags(options):
    flags = ["{fixture}/scene.ply", "--cameras", "{fixture}/cameras.json", "--view", "view",
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
            _, picture = bench.run(f"{name}-{path}", {"fixture": folder}, "splat", "render", *fixture_flags(options), "--path", path,
                                   "-o", "{out}.npz", keep=(".npz",))
            result = bench.compare(f"{name}-{path}-compared", os.path.join(folder, "expected.npz"), picture,
                                   os.path.join(folder, "reference.npz"))
            rows.append({"fixture": name, "path": path, "rules": options["rules"], "support": options["support"],
                         "all_db": decibels(result), "sure_db": decibels(result, "_outside_doubtful"),
                         "doubtful": result["doubtful_share"], "required": required,
                         "conversion_db": options["conversion_db_outside_doubtful"]})
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
            choice = ["--reciprocal", unit, "--sum", order] if path == "raster" else []
            result, found = bench.run(
                f"{name}-gradients-{path}-{unit}-{order}", {"fixture": folder}, "splat", "gradients", *fixture_flags(options), "--path", path,
                *choice, "--upstream", "{fixture}/upstream.npz", "-o", "{out}.npz", keep=(".npz",))
            checked = bench.path("checked.json")
            subprocess.run(("splat-check-gradients", os.path.join(folder, "gradients.npz"), found, "--json", checked),
                           stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False)
            with open(checked) as f:
                rows.append({"fixture": name, "path": path, "reciprocal": unit, "sum": order, "rules": options["rules"],
                             "wall_s": result["seconds"], "arrays": json.load(f)})
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
    rows, good = {"pictures": pictures, "fixtures": fixtures, "gradients": gradients}[args.mode](bench, args)
    with open(bench.path(args.mode + ".json"), "w") as f:
        json.dump(rows, f, indent=1)
    return 0 if good else 1


if __name__ == "__main__":
    command_line.run(main)
