#!/usr/bin/env python3
"""Compares the site's pages with what cmark-gfm makes of the documents: each has as many lists, items, tables, headings
and texts of code. The two read Markdown differently, and docs/site/pages.py makes up for it.

usage: structure.py SITE
Prints an error for each page that differs, then the number of pages. Exit codes: 0 none differs, 1 some do, 2 usage.
"""

import os
import re
import subprocess
import sys

KINDS = ("ul", "ol", "li", "table", "tr", "td", "th", "h1", "h2", "h3", "h4", "em", "strong", "pre", "code", "img")


def counts(html):
    return {kind: len(re.findall(rf"<{kind}[\s/>]", html)) for kind in KINDS}


def main():
    if len(sys.argv) != 2:
        print(__doc__, file=sys.stderr)
        return 2
    site, pages, differ = sys.argv[1], 0, 0
    for folder, _, names in sorted(os.walk(site + "-pages")):
        for name in sorted(n for n in names if n.endswith(".md")):
            document = os.path.join(folder, name)
            built = "index.html" if name == "README.md" else name.removesuffix(".md") + ".html"
            with open(os.path.join(site, os.path.relpath(folder, site + "-pages"), built), encoding="utf-8") as f:
                article = re.search(r"<article.*?</article>", f.read(), re.S).group()
            expected = counts(subprocess.run(["cmark-gfm", "-e", "table", "--unsafe", document], check=True,
                                             stdout=subprocess.PIPE, text=True).stdout)
            got = counts(article)
            wrong = [f"{got[k]} <{k}>, expected {expected[k]}" for k in KINDS if got[k] != expected[k]]
            if wrong:
                print(f"structure.py: error: {document}: {'; '.join(wrong)}", file=sys.stderr)
                differ += 1
            pages += 1
    print(f"{pages} pages")
    return 1 if differ else 0


if __name__ == "__main__":
    sys.exit(main())
