#!/usr/bin/env python3
"""Makes the note of docs/report/ (build/report/report.pdf) from the results of scripts/paper.sh: numbers, tables and figures.

usage: scripts/report.sh [OPTIONS]

exit codes: 0 done, 1 LaTeX failed, 2 usage, 3 no results of a section, or no LaTeX
"""

import argparse
import glob
import os
import shutil
import statistics
import subprocess
import sys

FOLDER = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.dirname(FOLDER))

import clocks  # noqa: E402
import document  # noqa: E402
import energy  # noqa: E402
import lines  # noqa: E402
import machines  # noqa: E402
import rates  # noqa: E402
import runs  # noqa: E402
import scaling  # noqa: E402
import scenes  # noqa: E402
import speedup  # noqa: E402
import tails  # noqa: E402
import tiles  # noqa: E402
import training  # noqa: E402
import writing  # noqa: E402
from verdicts import HOLDS, NOT, OPEN  # noqa: E402

SECTIONS = {"rates": rates, "speedup": speedup, "clocks": clocks, "tails": tails, "depth": None, "scaling": scaling, "tiles": tiles,
            "energy": energy, "training": training}
FIGURES = {"speedup": "speedup", "scaling": "scaling", "energy": "power"}  # the chart of each section
PROTOTYPE = machines.PROTOTYPES[0]
TOOLS = ("pdflatex", "rsvg-convert")


def span(values, form="{:.3g}"):
    values = list(values)
    return {"low": form.format(min(values)), "high": form.format(max(values))}


def of_rates(rows):
    fps = [row["serial"]["fps"] for row in rows if row["machine"] == PROTOTYPE]
    return {"fps": {**span(fps), "median": f"{statistics.median(fps):.3g}"}}


def of_speedup(rows):
    found = {}
    for name in ("fastest", "official"):
        of = [row[name] for row in rows if row[name]]
        found[f"speedup.{name}"] = span((one["serial"] for one in of), "{:.1f}")
        found[f"share.{name}"] = span((100 * one["blend_share"] for one in of), "{:.1f}")
    return found


def of_clocks(rows):
    return {"clocks": {key: f"{statistics.median(row[key] for row in rows):.3g}" for key in ("mcycles", "ms")}}


def of_scaling(rows):
    return {"scaling": span((scaling.at(row, 1)["blend_cycles"] / scaling.at(row, 16)["blend_cycles"] for row in rows if row["parts"] == 1),
                            "{:.1f}")}


def of_tails(rows):
    quarters = [next(p for p in row["points"] if p["rule"] == tails.QUARTER)["throughput"] for row in rows]
    best = [max(p["throughput"] for p in row["points"][1:]) for row in rows]
    return {"tails.quarter": span(100 * (one - 1) for one in quarters), "tails.best": span(100 * (one - 1) for one in best)}


def of_depth(rows):
    on = machines.SCALED[PROTOTYPE]
    stopped = max(row["max_abs"] for row in rows if row["stop"] == "stop")
    cycles = {}
    for row in rows:
        if row["stop"] == "stop" and on in row["cycles"]:
            view = cycles.setdefault((row["scene"], row["view"]), {})
            view[row["parts"]] = row["cycles"][on]["blend"] + row["cycles"][on]["merge"]
    gains = [view[1] / min(of for parts, of in view.items() if parts > 1) for view in cycles.values()]
    return {"depth": {"stop": f"{stopped:.2g}", "gain": f"{min(gains):.2g} to {max(gains):.2g}"}}


def of_tiles(rows):
    support = next(iter(rows[0]["fewer"]))
    fewer = {width: [row["fewer"][support][width] for row in rows if row["fewer"][support].get(width) is not None] for width in ("960", "3840")}
    return {"tiles": {"views": str(len(rows)), **{width: str(sum(one >= 0.8 for one in of)) for width, of in fewer.items()}}}


def of_training(rows):
    beside = [row for row in training.by_prototype({"rows": rows}) if row["kernels"]]
    if not beside:
        return {}
    return {"training.fastest": span((row["speedup"] for row in beside), "{:.1f}"),
            "training.back": span((row["back_speedup"] for row in beside), "{:.1f}")}


def of_energy(rows):
    one, mm2 = rows[0], 1e-6
    given = one["given"]
    area = one["area"]["chip_um2"]
    fast, slow = ([row["given"] for row in rows if row["clock"] == clock] for clock in energy.CLOCKS)
    alone = [of["area"]["chip_watts"] for of in fast]
    size = energy.part_um2(given["area"], energy.RASTERIZER) * mm2 / energy.RASTERIZERS
    ratio = {end: f"{energy.efficiency(given['area'], of):.2g}" for end, of in (("ratio", "value"), ("low", "high"), ("high", "low"))}
    return {"area": {"prior": f"{area['value'] * mm2:.2f}", "prior.low": f"{area['low'] * mm2:.2f}", "prior.high": f"{area['high'] * mm2:.2f}"},
            "given": {"area.tried": str(given["area"]["samples"]["tried"]), "kept": str(given["area"]["samples"]["kept"])},
            "power.area": {"factor": f"{statistics.median(of['high'] / of['low'] for of in alone):.2g}"},
            "power.both": span((of["area_and_power"]["chip_watts"]["value"] for of in fast), "{:.2g}"),
            "peak.both": span((of["area_and_power"]["peak_watts"]["value"] for of in fast), "{:.2g}"),
            "slow.both": span((of["area_and_power"]["chip_watts"]["value"] for of in slow), "{:.2g}"),
            "efficiency": {"": f"{size:.2g}", **ratio}}


def of_draws(drawn):
    """Beside the claims' rows."""
    said = lines.facts({"draws": drawn})["draws"]
    follows = ", ".join(f"{name} ({value:+.2f})" for value, name in said["follows"].get("fps", ()))
    stacks = said["splits"].get("figure_fps", {}).get("core.interleaved_stacks", {})
    return {"draws": str(said["count"]), "draws.notblending": said["not_blending"], "draws.follows": follows,
            **{f"draws.stacks.{level}": f"{held} of {count}" for level, (held, count) in stacks.items()}}


def numbers(data):
    """All that the text may name."""
    found = {}
    for name in data:
        for group, values in globals()["of_" + name](data[name]["rows"]).items():
            found.update({f"{group}.{key}".rstrip("."): value for key, value in values.items()})
    return found


def escaped(text):
    for sign, by in (("\\", r"\textbackslash{}"), ("%", r"\%"), ("&", r"\&"), ("_", r"\_"), ("#", r"\#"), ("<", r"$<$"), (">", r"$>$"), ("`", "")):
        text = text.replace(sign, by)
    return text


def tabular(columns, heads, rows):
    lines = [rf"\begin{{tabular}}{{{columns}}}", r"\toprule", " & ".join(heads) + r" \\", r"\midrule"]
    lines += [" & ".join(map(escaped, row)) + r" \\" for row in rows]
    return "\n".join([*lines, r"\bottomrule", r"\end{tabular}", ""])


def write(folder, name, text):
    with open(os.path.join(folder, name), "w", encoding="utf-8") as out:
        out.write(text)


# What stands in place of a number that no section has.
REFUSED = r"\def\unmeasured#1{\errmessage{no result #1, expected a section of scripts/paper.sh with it}}"
MARKED = r"\def\unmeasured#1{\emph{[not measured]}}"


def generate(data, drawn, partial, folder):
    """drawn: the result of section draws, or None; partial: mark what is not measured."""
    rows = document.ordered(document.rows_of({**data, **({"draws": drawn} if drawn else {})}))
    found = numbers(data)
    # Estimated rows have sentences for keys, which the note does not name.
    found.update({f"{what}.{row['key']}": row[what] for row in rows if row["key"].isidentifier() for what in ("ours", "held")})
    if drawn:
        found.update(of_draws(drawn))
    kinds = [row["verdict"] for row in rows]
    found.update(claims=str(len(rows)), clock=" and ".join(sorted({str(v) for of in data.values() for v in of.get("clocks", ())})),
                 **{what: str(kinds.count(verdict)) for what, verdict in (("holds", HOLDS), ("not", NOT), ("open", OPEN))})
    write(folder, "numbers.tex", (MARKED if partial else REFUSED) + "\n"
          + "".join(rf"\expandafter\def\csname result@{key}\endcsname{{{escaped(value)}}}" + "\n" for key, value in found.items()))
    write(folder, "claims.tex", tabular("p{76mm}p{34mm}p{24mm}p{34mm}", ("claim", "paper", "verdict", "holds in"),
                                        [(row["claim"], row["paper"], row["verdict"], row["held"]) for row in rows]))
    moved = energy.moved(data["energy"]["rows"][0]["given"]["area_and_power"]["rows"]) if "energy" in data else []
    write(folder, "moved.tex", tabular("llr", ("row", "of", "times"),
                                       [(row["row"], row["of"], energy.estimate(row["factor"])) for row in moved]))
    for name, title in FIGURES.items():
        if name not in data:
            write(folder, title + ".tex", r"\emph{[not measured]}")
            continue
        write(folder, title + ".tex", rf"\includegraphics[width=\columnwidth]{{{title}.pdf}}")
        write(folder, title + ".svg", writing.svg_of(SECTIONS[name].charts(data[name])[title], [f"scripts/paper.sh --sections {name}"]))


def typeset(folder):
    """Whether LaTeX makes the note; its log says why not."""
    shutil.copy(os.path.join(scenes.ROOT, "docs", "report", "report.tex"), folder)
    for svg in glob.glob(os.path.join(folder, "*.svg")):
        subprocess.run(["rsvg-convert", "-f", "pdf", "-o", svg.removesuffix("svg") + "pdf", svg], check=True)
    for _ in range(2):  # references
        done = subprocess.run(["pdflatex", "-interaction=nonstopmode", "-halt-on-error", "report.tex"], cwd=folder, check=False,
                              stdout=subprocess.DEVNULL)
        if done.returncode:
            return False
    return True


def main():
    parser = argparse.ArgumentParser(prog="report.sh", description=__doc__.split("\n\n")[0], epilog=__doc__.split("\n\n")[-1])
    parser.add_argument("--results", default=os.path.join(scenes.ROOT, "build", "paper"), metavar="FOLDER",
                        help="--out of scripts/paper.sh (default build/paper)")
    parser.add_argument("--out", default=os.path.join(scenes.ROOT, "build", "report"), metavar="FOLDER", help="default build/report")
    parser.add_argument("--no-pdf", action="store_true", help="numbers, tables and figures alone: without LaTeX")
    parser.add_argument("--partial", action="store_true", help="a draft: mark what is not measured")
    args = parser.parse_args()
    store = runs.Runs(args.results, 1, True, True)
    data = {name: found for name in SECTIONS if (found := store.read(name))}
    missing = [name for name in SECTIONS if name not in data]
    if missing and not args.partial:
        print(f"report.sh: error: {args.results}: no results of {', '.join(missing)}, expected scripts/paper.sh --sections "
              f"{' '.join(missing)}", file=sys.stderr)
        return 3
    lacking = [tool for tool in TOOLS if not args.no_pdf and not shutil.which(tool)]
    if lacking:
        print(f"report.sh: error: no {lacking[0]}, expected the Debian packages that scripts/README.md names, or --no-pdf", file=sys.stderr)
        return 3
    os.makedirs(args.out, exist_ok=True)
    generate(data, store.read("draws"), args.partial, args.out)
    if args.no_pdf:
        return 0
    if not typeset(args.out):
        print(f"report.sh: error: {args.out}/report.log: LaTeX failed, expected a document", file=sys.stderr)
        return 1
    print(f"{args.out}/report.pdf")
    return 0


if __name__ == "__main__":
    sys.exit(main())
