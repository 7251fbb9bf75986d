#!/usr/bin/env python3
"""Watches a training in headless Chromium: pictures, curves, pause, stop.

usage: train_view.py CAPTURE FOLDER
"""

import json
import os
import subprocess
import sys
import time
import urllib.parse

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "Inputs"))
from browser import Browser
from viewer import ask, refused

CAPTURE, FOLDER = sys.argv[1:]


def train(name, *options, most=300):
    return ["splat", "train", CAPTURE, "-o", os.path.join(FOLDER, name), "--max-gaussians", str(most), "--seed", "3", *options]


def iteration(browser):
    return int(browser.value("document.documentElement.dataset.iteration ?? 0"))


def reaches(browser, count):
    browser.wait(f"Number(document.documentElement.dataset.iteration) >= {count}")


def pixels(browser, canvas):
    return browser.value(f"(c => Array.from(c.getContext('2d').getImageData(0, 0, c.width, c.height).data).join())(document.querySelector('{canvas}'))")


def click(browser, name):
    browser.value(f"document.getElementById('{name}').click()")


def post(at, path, **body):
    return ask(at, "POST", path, json.dumps(body).encode())


def watch(browser, process, at):
    browser.open(at.geturl())
    reaches(browser, 2)
    browser.wait("document.getElementById('about').textContent.includes('after iteration')")
    assert len(set(pixels(browser, "#view-a canvas").split(","))) > 16
    assert len(set(pixels(browser, "#loss").split(","))) > 4
    click(browser, "pause")
    browser.wait("document.getElementById('status').textContent === 'paused'")
    # The iteration at hand ends first.
    held = -1
    while held != (held := iteration(browser)):
        time.sleep(1.2)
    browser.wait(f"document.getElementById('about').textContent.endsWith('after iteration {held}')")
    before = pixels(browser, "#view-a canvas")
    # Pictures come while it is paused, too.
    browser.key("ArrowLeft")
    browser.wait("document.getElementById('about').textContent.includes('moved')")
    assert pixels(browser, "#view-a canvas") != before
    assert iteration(browser) == held and "&eye=" in browser.value("location.href")
    # What is wrong is said, and what has no token.
    for path, body in (("/state", {}), ("/state", {"since": -1}), ("/picture", {"view": 99}), ("/picture", {"view": 0, "rotation": [1]}),
                       ("/picture", {"view": 0, "position": "far"}), ("/control", {"do": "burn"}), ("/control", {})):
        refused(post(at, path, **body), 400)
    refused(ask(at, "POST", "/control", b"[]"), 400)
    for method, path, body in (("GET", "/training", None), ("POST", "/control", b'{"do": "stop"}'), ("POST", "/state", b"{}"), ("POST", "/picture", b"{}")):
        refused(ask(at, method, path, body, token=False), 403)
    refused(ask(at, "GET", "/scene"), 404)
    click(browser, "pause")
    reaches(browser, held + 1)
    assert process.poll() is None
    for width, scheme in ((400, "dark"), (1200, "light"), (2000, "light")):
        browser.shape(width, 900, scheme)
        time.sleep(0.2)
        assert browser.value("document.documentElement.scrollWidth") <= width
        # What stands beside the picture begins at its side.
        band = browser.value("document.getElementById('panels').getBoundingClientRect().left - document.querySelector('.frame').getBoundingClientRect().right")
        assert width != 2000 or 0 < band < 30, band
        browser.screenshot(os.path.join(FOLDER, f"train-{width}.png"))


def started(*words):
    process = subprocess.Popen(train(*words), stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    said = process.stdout.readline()
    assert said.startswith("splat train: http://127.0.0.1:"), said
    return process, urllib.parse.urlsplit(said.split()[-1])


browser, process = Browser(FOLDER), None
try:
    process, at = started("stopped.ply", "--iterations", "100000", "--view", "--time", "--time-every", "1", "--score-every", "1")
    watch(browser, process, at)
    click(browser, "stop")
    assert process.wait(60) == 130, process.returncode
    assert os.path.exists(os.path.join(FOLDER, "stopped.ply.checkpoint")) and not os.path.exists(os.path.join(FOLDER, "stopped.ply"))
    print("a stop is an interrupt")
    # A run that is watched has the bits of one that is not.
    process, at = started("a.ply", "--iterations", "12", "--view", "--time", "--time-every", "3", "--json", os.path.join(FOLDER, "a.json"),
                          "--html", os.path.join(FOLDER, "a.html"))
    browser.open("about:blank")
    browser.open(at.geturl())
    browser.wait("document.getElementById('status')?.textContent === 'the run has ended' && /dB$/m.test(document.getElementById('facts').innerText)")
    assert process.wait(60) == 0
    subprocess.run(train("b.ply", "--iterations", "12", "--colour-rate", "0.01", "--json", os.path.join(FOLDER, "b.json"), most=301), check=True,
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    subprocess.run(train("c.ply", "--iterations", "12"), check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    contents = []
    for name in ("a.ply", "b.ply", "c.ply"):
        with open(os.path.join(FOLDER, name), "rb") as f:
            contents.append(f.read())
    assert contents[0] == contents[2] != contents[1]
    print("watching changes no bit")
    # Requests that a run's end left without an answer are no faults of the page.
    assert all(c.get("source") == "network" for c in browser.complaints), browser.complaints
finally:
    # After a failure a training goes on for days.
    if process:
        process.kill()
    browser.close()
