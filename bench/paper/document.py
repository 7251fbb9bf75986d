"""docs/paper-results.md and its pages, one a section, from the sections' results."""

import json
import os

import claims
import earlier
import joint
import lines
import writing
from verdicts import CONFIDENCE, HOLDS, LEAST, MOST, NOT, OPEN, interval_text, ratios, share_text, span, verdict

HEAD = "# The paper's results, measured here"
METHOD = f"""## How to read this page

| | |
|---|---|
| machines | the paper's text allows two cores, `vortex-5stage` and `forwarding` ([model.md](model.md#machines-that-have-a-name)). No parameter is fitted to a result |
| workloads | for its rates the table in the paper's figure 9 names the scene Train, of about 1 M Gaussians, which we do not have. Nothing names a resolution or a kernel |
| a frame | from projecting to the finished picture, with its launches and small copies, without uploading a scene or reading the picture back |
| *serial*, *overlapped* | one frame after the other, or a frame in the time of the longest of the paper's three stages: a bound, because nothing is charged for stages that share memory ([rates](paper/rates.md)) |
| baselines | kernels on the same machine without its rasterizers: *our fastest*, and *the official algorithm, step by step*: tiles of 16x16, a work-item a pixel, the exponential for every pixel of a tile and every Gaussian of its list |
| draws | every choice of ours and every value that no source states [is drawn at random](paper/draws.md): the link, launches, copies, queues, the core, caches, the baseline, the pipeline, and the error of the model |
| *ours* | the median, with 5 and 95 % of the trials |
| *holds in* | the trials in which a claim holds, with Wilson's interval of the share, {100 * CONFIDENCE:.0f} %. Trials are draws; where a claim was not drawn, they are views or iterations on both cores |
| {HOLDS} | in at least {100 * MOST:.0f} % of the trials |
| {NOT} | in at most {100 * LEAST:.0f} % |
| {OPEN} | otherwise, and where there is no rule |

A view reaches a figure if it has at least as much; "about" is within a factor of 2. Power and area
are estimated, not measured ([energy.md](energy.md)). Kernels are compiled for Zicond, Zba, Zbb and
Zbs, which the paper does not name; [what they gain](backend.md#extensions) is 1 to 4 % of a frame."""
# Beside the page, what it has of each claim: a run that measures only some sections takes the others from there.
KEPT = "claims.json"


def _row(claim, trials, section, of):
    large = claims.large_of(claim, trials)
    values = [trial.value for trial in large or trials]
    held = claims.held(claim, large or trials)
    row = {"key": claim.key, "group": claim.group, "section": section, "of": claim.section, "short": claim.short, "claim": claim.words, "paper": claim.paper,
            "ours": interval_text(values, claim.unit), "verdict": verdict(held, len(values)), "held": share_text(held, len(values), of)}
    if not large:
        # What less work does not reach, more does not either.
        row.update(verdict=NOT if not held and claim.less_is_easier else OPEN, held=f"{row['held']}, all smaller than the paper's")
    return row


def _estimated_row(group, section, row):
    """A row of a section that has an interval of each figure, and a verdict of its own."""
    said = row["verdict"] if row["verdict"] in (HOLDS, NOT, OPEN) else OPEN
    held = row.get("held", "" if said == row["verdict"] else row["verdict"])
    return {"key": row.get("key", row["claim"]), "group": group, "section": section, "of": section, "short": row.get("short", row["claim"]), "claim": row["claim"], "paper": row["paper"],
            "ours": row["ours"], "verdict": said, "held": held}


def _trials_of(section):
    return {"training": "iterations", "scaling": "views", "tiles": "counts of views"}.get(section, "views, cores and ways")


def rows_of(sections):
    """A row for each claim that was measured, of the draws where all of them have it."""
    found = {}
    for name, data in sections.items():
        if name in claims.ESTIMATED:
            group, make = claims.ESTIMATED[name]
            found.update({row["key"]: row for row in (_estimated_row(group, name, row) for row in make(data) if row)})
        elif name != "draws":
            found.update({claim.key: _row(claim, trials, name, _trials_of(name)) for claim, trials in claims.of_section(name, data)})
    if drawn := sections.get("draws"):
        found.update({claim.key: _row(claim, trials, "draws", "draws") for claim, trials in claims.of_draws(drawn, drawn["count"])})
    return found


def ordered(rows):
    """In the order of claims.py, and behind them those that sections make."""
    known = list(claims.BY_KEY)
    return sorted(rows.values(), key=lambda row: (claims.GROUPS.index(row["group"]), known.index(row["key"]) if row["key"] in known else len(known)))


def _anchored(page, title):
    return f"[{title}](paper/{page}.md)"


def _groups(rows):
    out = []
    for group in claims.GROUPS:
        lines_of = [(row["claim"], row["paper"], row["ours"], f"**{row['verdict']}**", row["held"], _anchored(row["section"], row["section"])) for row in rows
                    if row["group"] == group]
        lines_of += [(claim, paper, ours, f"**{said}**", "measured by itself", page) for of, claim, paper, said, ours, page in claims.ELSEWHERE if of == group]
        if lines_of:
            out += [f"## {group[0].upper()}{group[1:]}", "", *writing.table(("claim", "paper", "ours", "verdict", "holds in", "details"), lines_of)]
    return out


def _changed(rows):
    """Verdicts that are others than on the page before, and why."""
    changed = []
    for row in rows:
        said, why, *shown = earlier.VERDICTS.get(row["key"], (row["verdict"], ""))
        if said != row["verdict"]:
            changed.append((row["claim"], *(shown or [said]), row["verdict"], why))
    if not changed:
        return []
    return ["## Verdicts that changed", "", writing.paragraph(earlier.HEAD), "", *writing.table(("claim", "before", "now", "why"), changed)]


def _details(name, data):
    """What stands behind each claim of a section: a table of its views, and each command once with the claims that it decides."""
    found = claims.of_section(name, data)
    if name in claims.ESTIMATED:
        cells = [(row["claim"], f"**{row['verdict']}**", row["ratio"], row["ours"]) for row in claims.ESTIMATED[name][1](data) if row]
        return ["## Claims", "", *writing.table(("claim", "verdict", "ours over the paper's", "ours"), cells)]
    if not found:
        return []
    commands, cells = {}, []
    for claim, trials in found:
        for kind in dict.fromkeys(trial.kind for trial in trials):
            of = [trial for trial in trials if trial.kind == kind]
            cells.append((len(cells) + 1, claim.words + (f": {kind}" if kind else ""), f"{claims.held(claim, of)} of {len(of)}",
                          ratios(of, claim.number) if claim.number else "", span(of, claim.unit)))
            best = max(of, key=lambda trial: trial.value)
            commands.setdefault(best.command or "bench/invocations.py", []).append(len(cells))
    out = ["## Claims", "", "Commands are for the root of the repository, after `. scripts/env.sh`, of the view that has the most.", "",
           *writing.table(("", "claim", "views that keep to it", "ours over the paper's", "ours"), cells)]
    for command, numbers in commands.items():
        out += [f"- {', '.join(map(str, numbers))}:", f"  `{command}`"]
    return [*out, ""]


def _made_by(data):
    clocks = "".join(f" Version {v} of the clock." for v in data.get("clocks", ()))
    builds = " Programs: build " + ", ".join(f"`{b}`" for b in data["builds"]) + "." if data.get("builds") else ""
    return f"[The paper's results](../paper-results.md). Made by `scripts/paper.sh`; do not edit.{clocks}{builds}"


def _page(name, module, data, images):
    out = [f"# {module.TITLE}", "", _made_by(data), "", *_details(name, data), *module.text(data)]
    for title, described in module.charts(data).items():
        os.makedirs(images, exist_ok=True)
        builds = "; programs: build " + ", ".join(data["builds"]) if data["builds"] else ""
        svg = writing.svg_of(described, [f"scripts/paper.sh --sections {name}{builds}"])
        _write(os.path.join(images, f"paper-{title}.svg"), svg)
        out += [f"![{module.TITLE}](../images/paper-{title}.svg)", ""]
    if data.get("left_out"):
        out += ["## Not measured", "", f"{len(data['left_out'])} of the points:", "", *(f"- {point}" for point in data["left_out"][:20]), ""]
    return out


def _write(file, text):
    with open(file + ".new", "w", encoding="utf-8") as f:
        f.write(text)
    os.replace(file + ".new", file)


def _lines(some):
    return "\n".join(writing.wrapped("\n".join(some).split("\n"))).rstrip("\n") + "\n"


def _kept(file):
    try:
        with open(file, encoding="utf-8") as f:
            return json.load(f)
    except FileNotFoundError:
        return {"rows": {}, "facts": {}}


def write(file, sections):
    """sections: module and data (None: not measured) by name."""
    folder = os.path.dirname(os.path.abspath(file))
    pages, images = os.path.join(folder, "paper"), os.path.join(folder, "images")
    os.makedirs(pages, exist_ok=True)
    measured = {name: data for name, (_, data) in sections.items() if data}
    for name, data in measured.items():
        _write(os.path.join(pages, name + ".md"), _lines(_page(name, sections[name][0], data, images)))
    if "rates" in measured and "speedup" in measured:
        measured["joint"] = {"rows": joint.rows_of(measured["rates"], measured["speedup"])}
        _write(os.path.join(pages, "joint.md"), _lines(joint.page(measured["rates"], measured["speedup"])))
    before = _kept(os.path.join(pages, KEPT))
    # A claim stays as an earlier run left it while neither its section nor the draws have it.
    rows = {**before["rows"], **{key: row for key, row in rows_of(measured).items() if row["section"] == "draws" or
                                 before["rows"].get(key, {}).get("section") != "draws" or "draws" in measured}}
    facts = {**before["facts"], **lines.facts(measured)}
    facts["pages"] = {**facts.get("pages", {}), **_pages({name: data for name, (_, data) in sections.items() if data})}
    _write(os.path.join(pages, KEPT), json.dumps({"rows": rows, "facts": facts}, indent=1, ensure_ascii=False) + "\n")
    in_order = ordered(rows)
    out = [HEAD, "", *lines.ten(in_order, facts), "",
           "`scripts/paper.sh` makes this page (resumable); do not edit it. The page behind each claim has tables, views and commands; one says"
           " [what would make claims hold](paper/changes.md).", *_measured_with(facts["pages"]), "",
           *_groups(in_order), *lines.short_of_size(facts), *_changed(in_order), METHOD, ""]
    if "joint" in measured:
        out += [f"## {joint.TITLE}", "", *joint.text(measured["rates"], measured["speedup"])]
    out += ["## Pages", "", "`scripts/paper.sh --sections` and the word in code measures a page again.", "",
            *writing.table(("page", "section", "clock version", "hours", "points that are missing"), [_made(name, module, facts["pages"]) for name, (module, _) in sections.items()
                                                                                  if os.path.exists(os.path.join(pages, name + ".md"))])]
    left = [f"- {module.TITLE}: {claims.OPEN[name]}. `scripts/paper.sh --sections {name}`." for name, (module, _) in sections.items()
            if name in claims.OPEN and not os.path.exists(os.path.join(pages, name + ".md"))]
    if left:
        out += ["## Not measured", "", *left]
    _write(file, _lines(out))


def _pages(measured):
    """What each section's page is of, for runs that measure only other sections. A run that several sections share is counted in the first."""
    found, counted = {}, set()
    for name, data in measured.items():
        seconds = data.get("seconds", {})
        hours = sum(time for run, time in seconds.items() if run not in counted) / 3600
        counted |= set(seconds)
        found[name] = {"clocks": data.get("clocks", []), "hours": hours, "left_out": len(data.get("left_out", ()))}
    return found


def _measured_with(pages):
    """By version of the clock, latest first, which pages are of it, and how long they took."""
    versions = sorted({v for page in pages.values() for v in page["clocks"]}, reverse=True)
    if not versions:
        return []
    of = {v: [page for page in pages.values() if v in page["clocks"]] for v in versions}
    said = [f"version {v} of the clock in {sum(page['hours'] or 0 for page in of[v]):.1f} hours" for v in versions[:1]]
    said += [f"{len(of[v])} of the {len(pages)} pages with version {v}" for v in versions[1:]]
    return [f"Measured with {', '.join(said)} ([model.md](model.md#versions-of-the-clock)); hours are of wall time, each run counted in full."]


def _made(name, module, pages):
    page = pages.get(name, {"clocks": [], "hours": None, "left_out": 0})
    hours = "" if page["hours"] is None else f"{page['hours']:.1f}"
    return _anchored(name, module.TITLE), f"`{name}`", " ".join(map(str, page["clocks"])), hours, page["left_out"] or ""
