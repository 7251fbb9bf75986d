"""docs/paper-results.md from the sections' results."""

import os

import claims

CLAIMS = {"speedup": claims.of_speedup, "clocks": claims.of_clocks, "tails": claims.of_tails, "depth": claims.of_depth,
          "scaling": claims.of_scaling, "tiles": claims.of_tiles, "training": claims.of_training}

HEAD = """# The paper's results, measured here

Made by `scripts/paper.sh` (about an hour of one quiet core, resumable; `scripts/paper.sh --help`); do not edit. What the paper
says about rendering and training, each figure with ours beside it.

- Times are of the machine's clock ([model.md](model.md)), whose parameters come from the paper's text or a stated source: none
  is fitted to a result. A frame is from projecting to the finished picture with its launches and small copies, without uploading
  a scene or reading the picture back.
- The paper names no scene, resolution or kernel for its rates, so the three views of five scenes are measured at 960x544, none
  picked by its result (what is not measured yet is named at each table), with INRIA's rules and support `exact`. `prototype`
  (8 cores, 2 rasterizers, 530 MHz, 12.8 GB/s) and `scaled` (64, 16, 500 MHz, 51.2 GB/s) are in `isasim/configs/`.
- A figure *holds* if every view reaches it, *holds if* the view is one of those that do (they are named), and *does not hold* if
  none does. "About" is within a factor of 2. *ratio* is ours over the paper's, from the smallest to the largest view; *bound*:
  what no machine of this kind could exceed.
- Power and area are out of scope.
"""


def _claim_lines(rows):
    out = ["| claim | paper | verdict | ours | ratio | bound |", "|---|---|---|---|---|---|"]
    for row in rows:
        cells = (row["claim"], row["paper"], f"**{row['verdict']}**", row["ours"], row["ratio"], row["bound"])
        out.append("| " + " | ".join(cells) + " |")
    return [*out, ""]


def write(file, sections, build):
    """sections: module and data (None: not measured) by name; build: of the programs that are there now."""
    out = [HEAD + f"- Programs: build `{build}` (a hash of the tools and libraries that a result depends on), where a "
           "section names no other.\n", "## Claims", ""]
    rows = [row for name, (_, data) in sections.items() if data and name in CLAIMS for row in CLAIMS[name](data) if row]
    out += _claim_lines(rows)
    trained = "training" in sections and sections["training"][1]
    out += [f"- {what}: {said}." for what, said in (() if trained else claims.LATER_TRAINING) + claims.LATER] + [""]
    out += ["The command of each claim (of its best view, or of the one that decides; in the root of the repository, after "
            "`. scripts/env.sh`):", ""]
    out += [f"- {row['claim']}: `{row['command'] or 'bench/invocations.py'}`" for row in rows] + [""]
    images = os.path.join(os.path.dirname(os.path.abspath(file)), "images")
    for name, (module, data) in sections.items():
        out += [f"## {module.TITLE}", ""]
        if not data:
            out += [f"Not measured yet: `scripts/paper.sh --sections {name}`.", ""]
            continue
        if set(data["builds"]) - {build}:
            out += ["*Runs of build " + ", ".join(f"`{b}`" for b in data["builds"]) + ".*", ""]
        if data.get("left_out"):
            out += [f"*Not measured yet: {', '.join(data['left_out'])}.*", ""]
        out += module.text(data)
        for title, svg in module.charts(data).items():
            os.makedirs(images, exist_ok=True)
            with open(os.path.join(images, f"paper-{title}.svg"), "w", encoding="utf-8") as f:
                f.write(svg)
            out += [f"![{module.TITLE}](images/paper-{title}.svg)", ""]
    with open(file + ".new", "w", encoding="utf-8") as f:
        f.write("\n".join(out).rstrip("\n") + "\n")
    os.replace(file + ".new", file)
