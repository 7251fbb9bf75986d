"""docs/paper-results.md and its pages, one a section, from the sections' results."""

import os

import claims
import joint
import writing
from verdicts import DEPENDS, HOLDS, IF, NOT, NOT_COMPARABLE

HEAD = f"""# The paper's results, measured here

`scripts/paper.sh` makes this page (at most six hours of two cores, resumable); do not edit it. Each
figure of the paper about rendering and training stands beside ours. The page behind each claim has
tables, the ratio to the paper's figure, what bounds it, and the command. Of claims that do not hold
a page says [what would make them hold](paper/changes.md).

| | |
|---|---|
| machines | the paper's text allows two cores: `prototype` and `scaled` have the core `vortex-5stage`, `prototype-forwarding` and `scaled-forwarding` the core `forwarding` ([model.md](model.md#machines-that-have-a-name)). No parameter is fitted to a result |
| workloads | for its rates the table in the paper's figure 9 names the scene Train, which we do not have. Nothing names a resolution, a number of Gaussians or a kernel. Ours were chosen before measuring: 960x544, two of the scenes also 1920x1088, INRIA's rules, support `exact`. What is not measured is named |
| a frame | from projecting to the finished picture, with its launches and small copies, without uploading a scene or reading the picture back |
| *serial* | one frame after the other |
| *overlapped* | a frame in the time of the longest of the paper's three stages. This is a bound: it charges nothing for stages that use memory at the same time, and with queues of four commands `--overlap` reaches little of it ([rates](paper/rates.md)) |
| baselines | kernels on the same machine without its rasterizers: *our fastest*, and *the official algorithm, step by step*: 16x16 tiles, a work-item a pixel, the exponential for every pixel of a tile and every Gaussian of its list |

A view reaches a figure if it has at least as much; "about" is within a factor of 2.

| verdict | of the views measured |
|---|---|
| {HOLDS} | every one reaches the figure, on both cores |
| {IF} | some do, and they are named |
| {NOT} | none does, on either core |
| {DEPENDS} | some view on one core does, and none on the other |
| {NOT_COMPARABLE} | some or all do: the figure is a rate, and a rate depends on the size of the pictures and the number of Gaussians, which the paper does not say |

Power and area are estimated, not measured ([energy.md](energy.md)): a claim about them holds if
even the 95 % of the interval keep to it, does not hold if even the 5 % do not, and is open
otherwise.

Kernels are compiled for Zicond, Zba, Zbb and Zbs, which the paper does not name. [What they
gain](backend.md#extensions) is 1 to 4 % of a frame on both paths.
"""


def _anchored(page, title):
    return f"[{title}](paper/{page}.md)"


def _claims(name, module, rows):
    return ["| " + " | ".join((row["claim"], row["paper"], f"**{row['verdict']}**", row["ours"],
                               _anchored(name, module.TITLE.lower()))) + " |" for row in rows]


def _earlier(file, name):
    """The claims that an earlier run left in the document, if their page is there, too."""
    if not os.path.exists(file) or not os.path.exists(os.path.join(os.path.dirname(os.path.abspath(file)), "paper", name + ".md")):
        return []
    with open(file, encoding="utf-8") as f:
        return [line for line in f.read().split("\n") if line.startswith("| ") and line.endswith(f"(paper/{name}.md) |")]


def _details(rows):
    """What stands behind each claim of a page: a table, and each command once with the claims that it decides."""
    commands = {}
    for number, row in enumerate(rows, 1):
        commands.setdefault(row["command"] or "bench/invocations.py", []).append(number)
    cells = [(number, row["claim"], f"**{row['verdict']}**", row["ratio"], row["bound"]) for number, row in enumerate(rows, 1)]
    out = ["## Claims", "", *writing.table(("", "claim", "verdict", "ours over the paper's", "bound"), cells)]
    for command, numbers in commands.items():
        out += [f"- {', '.join(map(str, numbers))}:", f"  `{command}`"]
    return [*out, ""]


def _made_by(data):
    clocks = "".join(f" Version {v} of the clock." for v in data.get("clocks", ()))
    return f"Made by `scripts/paper.sh`; do not edit.{clocks} Programs: build " + ", ".join(f"`{b}`" for b in data["builds"]) + "."


def _page(name, module, data, rows, images):
    out = [f"# {module.TITLE}", "", "[The paper's results](../paper-results.md). " + _made_by(data) if data["builds"]
           else "[The paper's results](../paper-results.md). Made by `scripts/paper.sh`; do not edit.", ""]
    if data.get("left_out"):
        out += [f"*{len(data['left_out'])} points were [not measured](#not-measured).*", ""]
    if rows:
        out += ["Commands are for the root of the repository, after `. scripts/env.sh`. The numbers are those of the claims. Each "
                "command is of the view that has the most, or of the one that decides.", "", *_details(rows)]
    out += module.text(data)
    for title, described in module.charts(data).items():
        os.makedirs(images, exist_ok=True)
        builds = "; programs: build " + ", ".join(data["builds"]) if data["builds"] else ""
        svg = writing.svg_of(described, [f"scripts/paper.sh --sections {name}{builds}"])
        _write(os.path.join(images, f"paper-{title}.svg"), svg)
        out += [f"![{module.TITLE}](../images/paper-{title}.svg)", ""]
    if data.get("left_out"):
        out += ["## Not measured", "", *(f"- {point}" for point in data["left_out"]), ""]
    return out


def _write(file, text):
    with open(file + ".new", "w", encoding="utf-8") as f:
        f.write(text)
    os.replace(file + ".new", file)


def _lines(lines):
    return "\n".join(writing.wrapped("\n".join(lines).split("\n"))).rstrip("\n") + "\n"


def write(file, sections):
    """sections: module and data (None: not measured) by name."""
    folder = os.path.dirname(os.path.abspath(file))
    pages, images = os.path.join(folder, "paper"), os.path.join(folder, "images")
    os.makedirs(pages, exist_ok=True)
    found, earlier = [], set()
    for name, (module, data) in sections.items():
        if not data:
            if rows := _earlier(file, name):
                earlier.add(name)
                found.append((name, module, rows))
            continue
        rows = [row for row in claims.OF[name](data) if row] if name in claims.OF else []
        found.append((name, module, _claims(name, module, rows)))
        _write(os.path.join(pages, name + ".md"), _lines(_page(name, module, data, rows, images)))
    measured = {name: data for name, (_, data) in sections.items() if data}
    versions = sorted({v for data in measured.values() for v in data.get("clocks", ())})
    out = [HEAD, "**Measured with version " + ", ".join(map(str, versions)) + " of the clock**"
           f" ([model.md](model.md#versions-of-the-clock)). Each run counted in full, even beside others, they took {_hours(measured)} of wall time.", "",
           "## Claims", "", "| claim | paper | verdict | ours | details |", "|---|---|---|---|---|",
           *(row for _, _, rows in found for row in rows), ""]
    out += [f"- {what}: {said}." for what, said in claims.ELSEWHERE] + [""]
    out += [f"## {joint.TITLE}", ""]
    if "rates" in measured and "speedup" in measured:
        out += joint.text(measured["rates"], measured["speedup"])
        _write(os.path.join(pages, "joint.md"), _lines(joint.page(measured["rates"], measured["speedup"])))
    else:
        out += ["Not measured: it needs sections rates and speedup.", ""]
    out += ["## Pages", ""]
    out += [f"- {_anchored(name, module.TITLE)}" for name, module, _ in found] + [""]
    left = [f"- {module.TITLE}: not in the last run. Its claims are those of an earlier build, which its page names. `scripts/paper.sh --sections {name}`."
            for name, (module, _) in sections.items() if name in earlier]
    left += [f"- {module.TITLE}{': ' + claims.OPEN[name] if name in claims.OPEN else ''}. `scripts/paper.sh --sections {name}`."
            for name, (module, data) in sections.items() if not data and name not in earlier]
    left += [f"- {module.TITLE}: {len(data['left_out'])} points, which [its page](paper/{name}.md) names."
            for name, (module, data) in sections.items() if data and data.get("left_out")]
    if left:
        out += ["## Not measured", "", *left]
    _write(file, _lines(out))


def _hours(measured):
    """The sum over all runs, which sections share."""
    seconds = {run: time for data in measured.values() for run, time in data.get("seconds", {}).items()}
    return f"{sum(seconds.values()) / 3600:.1f} hours"
