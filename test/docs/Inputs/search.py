#!/usr/bin/env python3
"""Searches the site for words in headless Chromium, which opens a page from its file and reaches no network.

usage: search.py [--patience SECONDS] [--sections] SITE WORD...
Prints a line for each word: the word and the pages found, in the order shown. With --sections, it prints of each page found
its best section. A message in the browser's console and a
request that failed are errors. Exit codes: 0 done, 1 the search does not work, 2 usage.
"""

import argparse
import json
import os
import re
import sys
import tempfile
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "Inputs"))
from browser import Browser

# What the page says once its index is ready, and the results once there are any or none.
RESULTS = """(() => {
  const said = document.querySelector(".md-search-result__meta").textContent.trim();
  if (!/matching document|No matching/.test(said)) return null;
  return [...document.querySelectorAll(".md-search-result__item > .md-search-result__link")].map(a => a.href);
})()"""


# Types a word in place of the one before, and forgets its results.
TYPE = """(() => {
  document.querySelector(".md-search-result__meta").textContent = "";
  const query = document.querySelector("input.md-search__input");
  query.value = %s;
  query.dispatchEvent(new Event("keyup", {bubbles: true}));
})()"""


class OfflineBrowser(Browser):
    """One that complains of everything: what its console says of any level, and requests that failed."""

    def __init__(self, folder):
        super().__init__(folder, reaches=())
        self.send("Network.enable")

    def hear(self, method, parameters):
        if method == "Runtime.exceptionThrown":
            self.complaints.append(parameters["exceptionDetails"]["text"])
        elif method == "Log.entryAdded":
            self.complaints.append(parameters["entry"]["text"])
        elif method == "Network.loadingFailed":
            self.complaints.append(parameters["errorText"])

    def results(self, patience):
        end = time.monotonic() + patience
        while time.monotonic() < end:
            value = self.send("Runtime.evaluate", expression=RESULTS, returnByValue=True)["result"].get("value")
            if value is not None:
                return value
            time.sleep(0.1)
        return None


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--patience", type=float, default=60, help="seconds; only a search that never ends takes them")
    parser.add_argument("--sections", action="store_true")
    parser.add_argument("site")
    parser.add_argument("word", nargs="+")
    options = parser.parse_args()
    site = os.path.abspath(options.site)
    with tempfile.TemporaryDirectory() as folder:
        browser = OfflineBrowser(folder)
        # A page deep in the tree, because the names of its scripts begin with ../. It reads its index once.
        browser.open(f"file://{site}/docs/paper/rates.html?q={options.word[0]}")
        found = {options.word[0]: browser.results(options.patience)}
        for word in options.word[1:]:
            browser.value(TYPE % json.dumps(word))
            found[word] = browser.results(options.patience)
        browser.close()
    for word, places in found.items():
        if places is None:
            print(f"search.py: error: the search for {word} never ended: {browser.complaints}", file=sys.stderr)
            return 1
        places = [re.sub(r"\?[^#]*", "", os.path.relpath(p.removeprefix("file://"), site)) for p in places]
        if options.sections:
            places = dict(reversed([p.split("#") for p in places if "#" in p])).items()
            print(f"{word}:", *(f"{page}#{section}" for page, section in reversed(places)))
        else:
            print(f"{word}:", *(p.split("#")[0] for p in places))
    if browser.complaints:
        print(f"search.py: error: the browser complains: {browser.complaints}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
