#!/usr/bin/env python3
"""A picture of the upper part of a page that splat wrote, taken by headless Chromium.

usage: page.py PAGE.html OUT.png [--size WIDTHxHEIGHT]
"""

import argparse
import os
import sys
import tempfile
import time

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, os.pardir, "test", "Inputs"))
import browser

SETTLED = 1.5  # seconds, in which charts come to rest


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("page")
    parser.add_argument("output")
    parser.add_argument("--size", default="900x1000")
    args = parser.parse_args()
    width, height = map(int, args.size.split("x"))
    with tempfile.TemporaryDirectory() as folder:
        shown = browser.Browser(folder, reaches=())
        shown.shape(width, height)
        shown.send("Emulation.setScrollbarsHidden", hidden=True)
        shown.open("file://" + os.path.abspath(args.page))
        shown.wait("document.readyState == 'complete'")
        time.sleep(SETTLED)
        shown.screenshot(args.output)
        shown.close()


if __name__ == "__main__":
    main()
