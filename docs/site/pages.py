"""What the site needs beyond MkDocs: lists as CommonMark has them, and a search without a server.

MkDocs calls the functions on_*(), because mkdocs.yml names this file under hooks.
"""

import glob
import json
import os
import re
import shutil

FENCE = re.compile(r"^( *)(`{3,})([^`]*)$")
ITEM = re.compile(r"^( *)([-*+]|\d+[.)])( +)(?=\S)")


def as_python_markdown(text):
    """CommonMark's lists as Python-Markdown wants them: four columns a level, a blank line before the first item.

    A fence keeps only the language of its first line, as CommonMark reads it.
    """
    out = []
    items = []  # the column at which the text of each open item begins
    fence = None
    paragraph = False  # the line before belongs to a paragraph that no item begins with
    for line in text.split("\n"):
        column = len(line) - len(line.lstrip(" "))
        if fence:
            out.append(" " * 4 * len(items) + line[min(column, items[-1] if items else 0):])
            if line.strip() == fence:
                fence = None
            continue
        if not line.strip():
            out.append("")
            continue
        while items and column < items[-1]:
            items.pop()
        item = ITEM.match(line)
        # Four columns more than the text around are code.
        if item and column - (items[-1] if items else 0) < 4:
            if paragraph and out[-1]:
                out.append("")
            paragraph = False
            out.append(" " * 4 * len(items) + item[2] + " " + line[item.end():])
            items.append(item.end())
            continue
        paragraph = paragraph or not items or not out[-1]
        body = line[items[-1] if items else 0:]
        opened = FENCE.match(body)
        if opened:
            fence = opened[2]
            body = opened[1] + fence + (opened[3].split() or [""])[0]
        out.append(" " * 4 * len(items) + body)
    return "\n".join(out)


def named(nav):
    """The pages that a part of the navigation names."""
    if isinstance(nav, str):
        return {nav}
    return set().union(*(named(part) for part in (nav.values() if isinstance(nav, dict) else nav)))


def on_config(config):
    """Adds to the navigation the pages that it lacks: what reference.py made, the READMEs of folders, and what nobody
    gave a place."""
    made = sorted(os.path.relpath(p, config["docs_dir"]) for p in
                  glob.glob(os.path.join(config["docs_dir"], "docs", "reference", "*.md")))
    for part in config["nav"]:
        if isinstance(part, dict):
            part.get("Reference", []).extend(made)
    lacking = sorted({os.path.relpath(p, config["docs_dir"]) for p in
                      glob.glob(os.path.join(config["docs_dir"], "**", "*.md"), recursive=True)} - named(config["nav"]))
    readmes = [p for p in lacking if os.path.basename(p) == "README.md"]
    others = [p for p in lacking if p not in readmes]
    config["nav"] += ([{"More": others}] if others else []) + [{"Folders": [{os.path.dirname(p): p} for p in readmes]}]
    return config


def on_page_markdown(markdown, page, config, files):
    return as_python_markdown(markdown)


def boosted(index, config):
    """The search's index, in which entries of the pages of extra.boost have a factor, which mkdocs-material has since 8.3."""
    factors = {page.removesuffix(".md") + ".html": factor for page, factor in config["extra"].get("boost", {}).items()}
    for entry in index["docs"]:
        factor = factors.get(entry["location"].split("#")[0])
        if factor:
            entry["boost"] = factor
    return index


def on_post_build(config):
    """Writes index and worker of the search as scripts: a page opened from its file may load scripts, but neither
    other files nor a worker by its name. Removes what only a host on the web, a developer of the theme or a search in
    other languages uses.

    mkdocs-material 8 takes both from __search. Its version 9 takes the index from __index, once it has loaded
    search_index.js, and starts the worker by its name.
    """
    search = os.path.join(config["site_dir"], "search")
    with open(os.path.join(search, "search_index.json"), encoding="utf-8") as f:
        index = boosted(json.load(f), config)
    [worker] = glob.glob(os.path.join(config["site_dir"], "assets", "javascripts", "workers", "search.*.js"))
    with open(worker, encoding="utf-8") as f:
        source = re.sub(r"\bthis\.add\((\w+)\)", r"this.add(\1,{boost:\1.boost||1})", f.read())
    with open(os.path.join(search, "offline.js"), "w", encoding="utf-8") as f:
        f.write(f"""var __index = {json.dumps(index)};
var __search = {{index: Promise.resolve(__index),
  worker: URL.createObjectURL(new Blob([{json.dumps(source)}], {{type: "text/javascript"}}))}};
window.Worker = class extends Worker {{
  constructor(name) {{ super(name.endsWith("{os.path.basename(worker)}") ? __search.worker : name); }}
}};
""")
    with open(os.path.join(search, "search_index.js"), "w", encoding="utf-8") as f:
        f.write("// offline.js has the index.\n")
    # The map of the site has the day on which it was built, too.
    for name in ("404.html", "sitemap.xml", "sitemap.xml.gz", "assets/**/*.map"):
        for path in glob.glob(os.path.join(config["site_dir"], name), recursive=True):
            os.remove(path)
    shutil.rmtree(os.path.join(config["site_dir"], "assets", "javascripts", "lunr"), ignore_errors=True)
