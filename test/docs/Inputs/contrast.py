#!/usr/bin/env python3
"""Measures the contrast of every visible text of pages of the site, light and dark, by WCAG 2's formula.

usage: contrast.py [--pictures FOLDER] SITE PAGE...
Prints an error for each kind of text below 4.5:1, then the lowest contrast of each scheme. --pictures keeps screenshots of
400, 1200 and 2000 pixels. Exit codes: 0 all texts have 4.5, 1 some have less, 2 usage.
"""

import argparse
import os
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "Inputs"))
from browser import Browser

LEAST = 4.5

# [contrast, the element, its text] of each element with a text of its own that is visible.
TEXTS = """(() => {
  const rgba = css => { const v = css.match(/[\\d.]+/g).map(Number); return v.length < 4 ? [...v, 1] : v; };
  const over = (a, b) => [0, 1, 2].map(i => a[i] * a[3] + b[i] * (1 - a[3])).concat(1);
  const light = c => c.slice(0, 3).map(v => (v /= 255) <= 0.03928 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4)
    .reduce((sum, v, i) => sum + v * [0.2126, 0.7152, 0.0722][i], 0);
  const found = [];
  for (const e of document.querySelectorAll("body *")) {
    const text = [...e.childNodes].filter(n => n.nodeType == 3).map(n => n.data).join("").trim();
    const style = getComputedStyle(e), box = e.getBoundingClientRect();
    if (!text || !box.width || !box.height || style.visibility == "hidden") continue;
    const chain = [];
    for (let p = e; p; p = p.parentElement) chain.unshift(getComputedStyle(p));
    let back = [255, 255, 255, 1], opacity = 1;
    for (const s of chain) { back = over(rgba(s.backgroundColor), back); opacity *= s.opacity; }
    if (opacity < 0.1) continue;  // what appears under the mouse
    const colour = rgba(style.color);
    const [a, b] = [light(over([...colour.slice(0, 3), colour[3] * opacity], back)), light(back)].sort((x, y) => y - x);
    found.push([(a + 0.05) / (b + 0.05), `${e.tagName.toLowerCase()}.${e.className} in .${e.parentElement.className}`,
                text.slice(0, 40)]);
  }
  return found;
})()"""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--pictures")
    parser.add_argument("site")
    parser.add_argument("page", nargs="+")
    options = parser.parse_args()
    # The theme keeps the scheme of the first page, so each is set by the attribute that its styles read.
    low, seen = {"default": 21, "slate": 21}, set()
    with tempfile.TemporaryDirectory() as folder:
        browser = Browser(folder, reaches=())
        for page in options.page:
            for scheme in low:
                browser.shape(1600, 900)
                browser.open(f"file://{os.path.abspath(options.site)}/{page}")
                browser.wait('document.readyState == "complete" && !!document.querySelector("article h1")')
                browser.value(f"""document.body.dataset.mdColorScheme = "{scheme}";
                    document.head.insertAdjacentHTML("beforeend", "<style>* {{ transition: none !important }}</style>")""")
                for contrast, element, text in browser.value(TEXTS):
                    low[scheme] = min(low[scheme], contrast)
                    if contrast < LEAST and (scheme, element) not in seen:
                        seen.add((scheme, element))
                        print(f"contrast.py: error: {page}, {scheme}: {contrast:.2f} of {element}: {text}", file=sys.stderr)
                for width in (400, 1200, 2000) if options.pictures else ():
                    browser.shape(width, 900, mobile=width == 400)
                    name = page.removesuffix(".html").replace("/", "-")
                    browser.screenshot(os.path.join(options.pictures, f"{name}-{width}-{scheme}.png"))
        browser.close()
    print(f"{len(options.page)} pages, lowest contrast", ", ".join(f"{value:.1f} {scheme}" for scheme, value in low.items()))
    return 1 if seen else 0


if __name__ == "__main__":
    sys.exit(main())
