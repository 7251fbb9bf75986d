#!/usr/bin/env python3
"""viewers.py VIEWER MODULES SCRATCH: whether a viewer of the npm registry draws what splat writes, beside splat's own picture.

VIEWER is playcanvas or babylonjs, which get a .glb, or splat-transform, whose page of HTML has the scene inside. Chromium
draws without a GPU. Prints what the peer decided.
"""

import base64
import json
import math
import os
import re
import subprocess
import sys
import time

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(__file__), "..", "..", "Inputs"))
from browser import Browser  # noqa: E402

viewer, modules, scratch = sys.argv[1:]
modules, scratch = os.path.abspath(modules), os.path.abspath(scratch)
WIDTH, HEIGHT = 480, 272
# Viewers cut off, sort and round in other ways than the rules of INRIA.
LEAST_DB = 25


def path(name):
    return os.path.join(scratch, name)


def run(*words):
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{' '.join(words)}: {done.stdout}{done.stderr}")
    return done.stdout


def view_of(camera):
    """A camera of cameras.json in glTF's axes: x and y are the other way round."""
    turn = np.diag([-1.0, -1.0, 1.0])
    place, rotation = turn @ camera["position"], turn @ np.array(camera["rotation"])
    return {"from": place.tolist(), "at": (place + rotation[:, 2]).tolist(), "up": (-rotation[:, 1]).tolist(),
            "fov": math.degrees(2 * math.atan(camera["height"] / 2 / camera["fy"]))}


def page():
    """The page to open, and the picture that it is to show, or nothing."""
    run("splat", "demo-scene", "-o", path("scene.ply"), "--cameras", path("cameras.json"), "--gaussians", "3000")
    if viewer == "splat-transform":
        run("node", os.path.join(modules, "@playcanvas", "splat-transform", "bin", "cli.mjs"), "-q", "-w", "-g", "cpu", path("scene.ply"),
            path("page.html"))
        return None
    run("splat", "convert", path("scene.ply"), "--axes", "rdf:luf", "-o", path("scene.glb"))
    run("splat", "render", path("scene.ply"), "--cameras", path("cameras.json"), "--view", "front", "--size", f"{WIDTH}x{HEIGHT}", "-o", path("ours.png"),
        "--write-cameras", path("used.json"))
    with open(path("used.json"), encoding="utf-8") as file:
        view = view_of(json.load(file)[0])
    with open(path("scene.glb"), "rb") as file:
        glb = base64.b64encode(file.read()).decode()
    template = os.path.join(os.path.dirname(__file__), {"playcanvas": "playcanvas", "babylonjs": "babylon"}[viewer] + ".html")
    with open(template, encoding="utf-8") as file:
        text = file.read()
    for name, value in (("MODULES", modules), ("WIDTH", WIDTH), ("HEIGHT", HEIGHT), ("VIEW", json.dumps(view)), ("GLB", glb)):
        text = re.sub(rf"\b{name}\b", str(value), text)
    with open(path("page.html"), "w", encoding="utf-8") as file:
        file.write(text)
    return path("ours.png")


def main():
    os.makedirs(scratch, exist_ok=True)
    package = "@playcanvas/splat-transform" if viewer == "splat-transform" else viewer
    with open(os.path.join(modules, package, "package.json"), encoding="utf-8") as file:
        version = json.load(file)["version"]
    ours = page()
    browser = Browser(scratch, WIDTH, HEIGHT, options=("--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"))
    try:
        browser.shape(WIDTH, HEIGHT)
        browser.open("file://" + path("page.html"))
        if ours:
            browser.wait("window.drawn || window.failed", 120)
            failed = browser.value("window.failed")
            if failed:
                sys.exit(f"{viewer}: {failed}")
            browser.screenshot(path("theirs.png"))
        else:
            browser.wait("document.readyState === 'complete'")
            # Before the scene is drawn there is one colour, and a bar.
            end = time.monotonic() + 120
            while time.monotonic() < end:
                browser.screenshot(path("theirs.png"))
                if os.path.getsize(path("theirs.png")) > 30000:
                    break
                time.sleep(1)
            else:
                sys.exit(f"{viewer}: the page shows nothing: {path('theirs.png')}")
    finally:
        browser.close()
    if not ours:
        print(f"peer {viewer} {version}: a page of {os.path.getsize(path('page.html')) / 1e6:.1f} MB shows the scene")
        return
    said = run("splat", "compare", path("ours.png"), path("theirs.png"))
    decibels = float(re.search(r"([\d.]+) dB", said)[1])
    if decibels < LEAST_DB:
        sys.exit(f"{viewer}: {decibels} dB beside splat's picture, expected {LEAST_DB}: {path('theirs.png')}")
    print(f"peer {viewer} {version}: draws a .glb, {decibels:.1f} dB beside splat's picture")


main()
