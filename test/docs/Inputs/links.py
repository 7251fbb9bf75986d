#!/usr/bin/env python3
"""Looks at every page of the site: what it loads is in the site, and every link inside the site leads somewhere.

usage: links.py SITE
Prints an error for each fault, then the number of pages. Exit codes: 0 no fault, 1 faults, 2 usage.
"""

import os
import re
import sys
from html.parser import HTMLParser
from urllib.parse import urlsplit

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "Inputs"))
from followed import report, target_of

# The attributes by which a browser loads something by itself. A <link> loads unless it only names another page.
LOADS = {"script": "src", "img": "src", "iframe": "src", "source": "src", "object": "data", "embed": "src",
         "video": "src", "audio": "src"}
ONLY_NAMES = {"canonical", "prev", "next", "alternate", "edit"}


class Page(HTMLParser):
    def __init__(self, path):
        super().__init__()
        self.loads, self.links, self.anchors = [], [], set()
        with open(path, encoding="utf-8") as f:
            self.feed(f.read())

    def handle_starttag(self, tag, attrs):
        attrs = dict(attrs)
        self.anchors.update(attrs[a] for a in ("id", "name") if attrs.get(a))
        if tag in LOADS and attrs.get(LOADS[tag]):
            self.loads.append(attrs[LOADS[tag]])
        if tag == "link" and not ONLY_NAMES & set((attrs.get("rel") or "").split()):
            self.loads.append(attrs["href"])
        self.loads += re.findall(r"url\(\s*['\"]?([^'\")]+)", attrs.get("style") or "")
        if tag == "a" and attrs.get("href"):
            self.links.append(attrs["href"])


def main():
    if len(sys.argv) != 2:
        print(__doc__, file=sys.stderr)
        return 2
    site = os.path.abspath(sys.argv[1])
    files = {os.path.join(f, n) for f, _, names in os.walk(site) for n in names}
    pages = {p: Page(p) for p in sorted(files) if p.endswith(".html")}
    faults = []
    for path, page in pages.items():
        name = os.path.relpath(path, site)
        for kind, uses in (("loads", page.loads), ("links to", page.links)):
            for use in uses:
                found = target_of(path, use)
                if not found:
                    if kind == "loads" and urlsplit(use).scheme != "data":
                        faults.append(f"{name} {kind} {use}, which is outside")
                    continue
                target, place = found
                if target not in files:
                    faults.append(f"{name} {kind} {use}, which is missing")
                elif target in pages and place and place not in pages[target].anchors:
                    faults.append(f"{name} {kind} {use}, but the page has no such place")
    for path in sorted(p for p in files if p.endswith(".css")):
        with open(path, encoding="utf-8") as f:
            for use in re.findall(r"url\(\s*['\"]?([^'\")]+)|@import\s+['\"]([^'\"]+)", f.read()):
                if re.match(r"(https?:)?//", use[0] or use[1]):
                    faults.append(f"{os.path.relpath(path, site)} loads {use[0] or use[1]}, which is outside")
    return report("links.py", faults, len(pages), sum(len(p.links) for p in pages.values()))


if __name__ == "__main__":
    sys.exit(main())
