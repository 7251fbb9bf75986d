#!/usr/bin/env python3
"""Uses the page of `splat view` as one who works with it: its address, its size, its files, edits, a restart.

usage: view_state.py SCENE CAMERAS FOLDER
"""

import json
import os
import re
import signal
import subprocess
import sys
import time
import urllib.parse

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "Inputs"))
import png_file
from browser import Browser
from viewer import ask, refused, viewer

SCENE, CAMERAS, FOLDER = sys.argv[1:]


def rest(browser):
    """Until the whole picture of what is looked at is shown."""
    browser.wait("document.documentElement.dataset.drawn !== undefined && document.getElementById('status').textContent.startsWith('whole picture')")


def settled(browser, act):
    before = browser.value("document.documentElement.dataset.drawn")
    act()
    browser.wait(f"document.documentElement.dataset.drawn !== undefined && document.documentElement.dataset.drawn !== '{before}'")
    rest(browser)


def opened(browser, address):
    browser.open("about:blank")
    browser.open(address)
    rest(browser)


def click(browser, name):
    browser.value(f"document.getElementById('{name}').click()")


def choose(browser, name, value):
    browser.value(f"(e => {{ e.value = '{value}'; e.dispatchEvent(new Event('change')); }})(document.getElementById('{name}'))")


def shown(browser):
    """Size and pixels of the picture."""
    width, height, text = browser.value(
        "(c => [c.width, c.height, Array.from(c.getContext('2d').getImageData(0, 0, c.width, c.height).data).join()])(document.querySelector('#view-a canvas'))")
    return (width, height), bytes(map(int, text.split(",")))


def is_picture(picture, file):
    (width, height), pixels = picture
    ours, report = os.path.join(FOLDER, "ours.png"), os.path.join(FOLDER, "same.json")
    png_file.write(ours, [pixels[4 * width * y:4 * width * (y + 1)] for y in range(height)], 4)
    subprocess.run(["splat", "compare", ours, file, "--json", report], check=True, stdout=subprocess.DEVNULL)
    with open(report, encoding="utf-8") as f:
        return json.load(f)["equal"]


def file_of(name):
    """A file of downloads, once it is whole."""
    path, end = os.path.join(FOLDER, name), time.monotonic() + 20
    while not os.path.exists(path):
        assert time.monotonic() < end, (name, os.listdir(FOLDER))
        time.sleep(0.05)
    return path


def check_size(browser):
    (width, height), _ = shown(browser)
    box = browser.value("(b => [b.width, b.height])(document.querySelector('#view-a canvas').getBoundingClientRect())")
    assert abs(box[0] - width) < 1 and abs(box[1] - height) < 1, (width, height, box)
    settled(browser, lambda: browser.shape(700, 500))
    assert shown(browser)[0] != (width, height)
    assert browser.value("document.documentElement.scrollWidth") <= 700
    settled(browser, lambda: browser.shape(500, 400))
    print("the size is the window's")


def check_address(browser):
    settled(browser, lambda: choose(browser, "layer", "error"))
    legend = browser.value("document.querySelector('#view-a .legend').innerText")
    assert "1e-8" in legend and "1e-4" in legend, legend
    settled(browser, lambda: choose(browser, "knob-exp-a", "poly2"))
    settled(browser, lambda: browser.key("ArrowLeft"))
    before, address = shown(browser), browser.value("location.href")
    assert all(part in address for part in ("&layer=error", "&left=exp=poly2", "&camera=front", "&eye=")), address
    browser.send("Page.reload")
    time.sleep(0.2)
    rest(browser)
    assert shown(browser) == before and browser.value("location.href") == address
    assert browser.value("document.getElementById('camera').value") == ""
    settled(browser, lambda: choose(browser, "layer", "picture"))
    print("a reload keeps what is looked at")


def check_files(browser):
    click(browser, "save")
    name = browser.value("document.title").removesuffix(".ply") + "-free.png"
    assert is_picture(shown(browser), file_of(name))
    click(browser, "copy")
    command = browser.wait("document.getElementById('command').value")
    subprocess.run(["bash", "-c", command], check=True, stdout=subprocess.DEVNULL, cwd=FOLDER)
    browser.value("document.activeElement.blur()")
    drawn = re.search(r"-o (\S+)$", command)[1]
    assert is_picture(shown(browser), os.path.join(FOLDER, drawn)), command
    print("the command draws the picture")


def centre_of(browser):
    return browser.value("(b => [b.left + b.width / 2, b.top + b.height / 2, b.width, b.height])(document.querySelector('#view-a canvas').getBoundingClientRect())")


def point_at(browser, x, y):
    return browser.value("(async () => { const { readFrame } = await import('./api.js'); const camera = window.asked.camera;"
                         f"return (await readFrame({{ camera, setting: window.asked.setting, layer: 'depth', x: Math.floor({x} * camera.width), "
                         f"y: Math.floor({y} * camera.height) }})).facts.point; }})()")


def check_double_click(browser):
    browser.value("(send => { window.fetch = (path, options) => { if (path === 'frame') window.asked = JSON.parse(options.body); "
                  "return send(path, options); }; })(window.fetch)")
    settled(browser, lambda: browser.key("r"))
    x, y, width, height = centre_of(browser)
    places = [(0.5, 0.4), (0.45, 0.5), (0.55, 0.55), (0.4, 0.45), (0.6, 0.5)]
    there, point = next((p, found) for p in places if (found := point_at(browser, *p)))
    at = (x + (there[0] - 0.5) * width, y + (there[1] - 0.5) * height)

    def twice():
        for _ in range(2):
            browser.mouse("mousePressed", *at)
            browser.mouse("mouseReleased", *at)

    settled(browser, twice)
    camera = browser.value("window.asked.camera")
    to = [p - c for p, c in zip(point, camera["position"])]
    ahead = [row[2] for row in camera["rotation"]]
    along = sum(a * b for a, b in zip(to, ahead))
    aside = sum(v * v for v in to) - along * along
    assert along > 0 and aside < 1e-5 * along * along, (point, camera)
    settled(browser, lambda: browser.key("r"))
    print("a double click turns to the point")


def convert(*options):
    made = os.path.join(FOLDER, "made.ply")
    subprocess.run(["splat", "convert", SCENE, *options, "-o", made], check=True, stdout=subprocess.DEVNULL)
    with open(made, "rb") as f:
        return f.read()


def select(browser, tool, *values):
    browser.value("document.getElementById('edit-panel').open = true")
    choose(browser, "tool", tool)
    browser.value(f"[...document.querySelectorAll('#shape input')].forEach((e, n) => {{ e.value = {list(values)}[n]; e.dispatchEvent(new Event('input')); }})")
    browser.wait("/are selected/.test(document.getElementById('selected').textContent)")


def saved(browser, at):
    status, content, _ = ask(at, "GET", "/saved?name=x.ply")
    assert status == 200
    return content


def check_edits(browser, at):
    count = json.loads(ask(at, "GET", "/scene")[1])["gaussians"]
    for tool, values, button, options in (
            ("box", [-0.5, -0.6, -10, 0.7, 10, 10], "crop", ["--crop-box=-0.5,-0.6,-10,0.7,10,10"]),
            ("sphere", [0, 0, 0, 1], "crop", ["--crop-sphere=0,0,0,1"]),
            ("fainter", [0.4], "delete", ["--drop-faint", "0.4"]),
            ("larger", [0.2], "delete", ["--drop-large", "0.2"])):
        select(browser, tool, *values)
        settled(browser, lambda button=button: click(browser, button))
        wanted = convert(*options)
        assert saved(browser, at) == wanted, (tool, len(saved(browser, at)), len(wanted))
        assert 0 < json.loads(ask(at, "GET", "/scene")[1])["gaussians"] < count, tool
        settled(browser, lambda: click(browser, "undo"))
        assert saved(browser, at) == convert()
    # A stroke over the whole picture, and part of it taken out again.
    choose(browser, "tool", "brush")
    x, y, width, height = centre_of(browser)

    def stroke(start, modifiers=0):
        browser.mouse("mousePressed", x + start * width, y, buttons=1, modifiers=modifiers)
        for n in range(1, 9):
            browser.mouse("mouseMoved", x + (start + n * 0.05) * width, y + (n % 2) * 3, buttons=1, modifiers=modifiers)
        browser.mouse("mouseReleased", x + (start + 0.4) * width, y, modifiers=modifiers)
        browser.wait("/are selected/.test(document.getElementById('selected').textContent)")
        return int(browser.value("parseInt(document.getElementById('selected').textContent.replaceAll(',', ''))"))

    more = stroke(-0.4)
    assert stroke(0, 8) <= more > 0
    settled(browser, lambda: click(browser, "delete"))
    # With cycles: what is measured is the scene that is shown.
    assert "cycles of the machine" in browser.value("document.getElementById('facts').innerText")
    draws = json.loads(ask(at, "POST", "/command", json.dumps({"camera": browser.value("window.asked.camera")}).encode())[1])["command"]
    assert " render s-edited.ply " in draws, draws
    left = json.loads(ask(at, "GET", "/scene")[1])["gaussians"]
    assert 0 < left < count
    settled(browser, lambda: click(browser, "undo"))
    # What is wrong is said.
    number = json.loads(ask(at, "GET", "/number")[1])["scene"]
    for body in ({"parts": [{"box": [1, 2]}]}, {"parts": [{}]}, {"parts": 3}, {"do": "burn", "scene": number}, {"do": "delete"},
                 {"do": "undo", "scene": number}, {"do": "delete", "scene": number, "parts": []}, {"do": "delete", "scene": number + 1, "parts": []},
                 {"do": "delete", "scene": number, "parts": [{"sphere": [0, 0, 0, 1e9]}]}):
        refused(ask(at, "POST", "/selection" if "do" not in body else "/edit", json.dumps(body).encode()), 400)
    refused(ask(at, "GET", "/saved?name=x.txt"), 400)
    refused(ask(at, "GET", "/saved?name=x.ply", token=False), 403)
    choose(browser, "tool", "")
    print("edits are those of convert")


def check_restart(browser, address, port):
    """A page goes on with a restarted server once the new address is open somewhere."""
    before = shown(browser)
    browser.wait("document.documentElement.dataset.away === 'yes'", 20)
    with viewer(SCENE, "--cameras", CAMERAS, "--port", str(port)) as at:
        browser.wait("document.getElementById('problem').textContent.includes('new address')", 20)
        assert at.fragment not in browser.value("location.href")
        other = browser.send("Target.createTarget", url=at.geturl())["targetId"]
        browser.wait(f"location.href.includes('{at.fragment}')", 20)
        rest(browser)
        assert shown(browser) == before and "&eye=" in browser.value("location.href")
        browser.send("Target.activateTarget", targetId=other)
        browser.wait("document.hidden")
    # A page that nobody looks at does not learn that its server was away, and goes on, too.
    browser.value("new BroadcastChannel('splat').onmessage = () => { window.hasHeard = true; }; 0")
    with viewer(SCENE, "--cameras", CAMERAS, "--port", str(port)) as at:
        browser.send("Target.createTarget", url=at.geturl())
        browser.wait("window.hasHeard", 20)
        assert at.fragment not in browser.value("location.href")
        browser.send("Page.bringToFront")
        browser.wait(f"location.href.includes('{at.fragment}')", 20)
    print("a restarted server takes the page back")


browser = Browser(FOLDER, 900, 700)
try:
    with viewer(SCENE, "--cameras", CAMERAS) as at:
        browser.send("Browser.setDownloadBehavior", behavior="allow", downloadPath=FOLDER)
        opened(browser, at.geturl())
        check_size(browser)
        check_address(browser)
        check_files(browser)
        check_double_click(browser)
        check_edits(browser, at)
        settled(browser, lambda: browser.key("ArrowLeft"))
        # A refused edit of a request by hand is no complaint of the page.
        assert not browser.complaints, browser.complaints
    check_restart(browser, at.geturl(), at.port)
finally:
    browser.close()
