#!/usr/bin/env python3
"""A picture of the viewer: two settings of a scene side by side, and what a pixel is made of.

usage: viewer.py SCENE CAMERAS OUT.png
"""

import argparse
import os
import subprocess
import sys
import tempfile

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, os.pardir, "test", "Inputs"))
import browser

STATE = "&errors=on&two=on&right=exp=poly2"
PIXEL = (0.55, 0.55)  # shares of the picture


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name in ("scene", "cameras", "output"):
        parser.add_argument(name)
    args = parser.parse_args()
    server = subprocess.Popen(["splat", "view", args.scene, "--cameras", args.cameras, "--size", "480x272"], stdout=subprocess.PIPE, text=True)
    try:
        address = server.stdout.readline().split()[-1]
        with tempfile.TemporaryDirectory() as folder:
            shown = browser.Browser(folder)
            shown.shape(1200, 760)
            shown.send("Emulation.setScrollbarsHidden", hidden=True)
            shown.open(address + STATE)
            shown.wait("document.documentElement.dataset.drawn !== undefined", 600)
            left, top, width, height = shown.value(
                "(b => [b.left, b.top, b.width, b.height])(document.querySelector('#view-a canvas').getBoundingClientRect())")
            at = (left + PIXEL[0] * width, top + PIXEL[1] * height)
            shown.mouse("mousePressed", *at)
            shown.mouse("mouseReleased", *at)
            shown.wait("!document.getElementById('gaussians').hidden")
            shown.screenshot(args.output)
            shown.close()
    finally:
        server.terminate()
        server.wait()


if __name__ == "__main__":
    main()
