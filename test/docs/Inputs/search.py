#!/usr/bin/env python3
"""Searches the site for words in headless Chromium, which opens a page from its file and reaches no network.

usage: search.py [--patience SECONDS] SITE WORD...
Prints a line for each word: the word and the pages found, in the order shown. A message in the browser's console and a
request that failed are errors. Exit codes: 0 done, 1 the search does not work, 2 usage.
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile
import time

# What the page says once its index is ready, and the results once there are any or none.
RESULTS = """(() => {
  const said = document.querySelector(".md-search-result__meta").textContent.trim();
  if (!/matching document|No matching/.test(said)) return null;
  return [...document.querySelectorAll(".md-search-result__item > .md-search-result__link")].map(a => a.href);
})()"""


class Browser:
    """Chromium with its DevTools protocol on a pipe: a JSON object and a zero byte a message."""

    def __init__(self, folder):
        take, send = os.pipe()
        get, put = os.pipe()

        def wire():  # it reads from 3 and writes to 4
            low, high = os.dup(take), os.dup(put)
            os.dup2(low, 3)
            os.dup2(high, 4)

        self.process = subprocess.Popen(
            ["chromium", "--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
             "--disable-background-networking", "--disable-component-update", "--disable-sync",
             "--disable-dev-shm-usage", "--host-resolver-rules=MAP * ~NOTFOUND", f"--user-data-dir={folder}",
             "--remote-debugging-pipe"], preexec_fn=wire, close_fds=False, stderr=subprocess.DEVNULL)
        os.close(take)
        os.close(put)
        self.send, self.get = send, os.fdopen(get, "rb", buffering=0)
        self.left, self.calls, self.session, self.complaints = b"", 0, None, []

    def message(self):
        while b"\0" not in self.left:
            more = self.get.read(1 << 16)
            if not more:
                raise EOFError("Chromium ended")
            self.left += more
        text, self.left = self.left.split(b"\0", 1)
        return json.loads(text)

    def call(self, method, **params):
        self.calls += 1
        wanted = {"id": self.calls, "method": method, "params": params}
        if self.session:
            wanted["sessionId"] = self.session
        os.write(self.send, json.dumps(wanted).encode() + b"\0")
        while True:
            got = self.message()
            if got.get("id") == self.calls:
                assert "error" not in got, got
                return got["result"]
            if got.get("method") == "Runtime.exceptionThrown":
                self.complaints.append(got["params"]["exceptionDetails"]["text"])
            if got.get("method") == "Log.entryAdded":
                self.complaints.append(got["params"]["entry"]["text"])
            if got.get("method") == "Network.loadingFailed":
                self.complaints.append(got["params"]["errorText"])

    def results(self, patience):
        end = time.monotonic() + patience
        while time.monotonic() < end:
            value = self.call("Runtime.evaluate", expression=RESULTS, returnByValue=True)["result"].get("value")
            if value is not None:
                return value
            time.sleep(0.1)
        return None


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--patience", type=float, default=60, help="seconds; only a search that never ends takes them")
    parser.add_argument("site")
    parser.add_argument("word", nargs="+")
    options = parser.parse_args()
    site = os.path.abspath(options.site)
    with tempfile.TemporaryDirectory() as folder:
        browser = Browser(folder)
        page = browser.call("Target.createTarget", url="about:blank")["targetId"]
        browser.session = browser.call("Target.attachToTarget", targetId=page, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            browser.call(f"{domain}.enable")
        found = {}
        for word in options.word:
            # A page deep in the tree, because the names of its scripts begin with ../.
            browser.call("Page.navigate", url=f"file://{site}/docs/paper/rates.html?q={word}")
            found[word] = browser.results(options.patience)
        browser.session = None
        browser.call("Browser.close")
        browser.process.wait()
    for word, places in found.items():
        if places is None:
            print(f"search.py: error: the search for {word} never ended: {browser.complaints}", file=sys.stderr)
            return 1
        print(f"{word}:", *(os.path.relpath(p.removeprefix("file://").split("#")[0].split("?")[0], site) for p in places))
    if browser.complaints:
        print(f"search.py: error: the browser complains: {browser.complaints}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
