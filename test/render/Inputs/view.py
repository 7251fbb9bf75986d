#!/usr/bin/env python3
"""Runs `splat view`, asks its server what it must refuse, and uses its page in headless Chromium.

usage: view.py SCENE CAMERAS SOG LENSES FOLDER

LENSES is a folder of distorted.py.
"""

import json
import math
import os
import subprocess
import sys
import zipfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "Inputs"))
import png_file
import viewer as server
from browser import Browser
from viewer import ask, frame, refused

SCENE, CAMERAS, SOG, LENSES, FOLDER = sys.argv[1:]
SIZE = (96, 64)


def viewer(*options, cameras=CAMERAS, size=SIZE):
    return server.viewer(SCENE, "--cameras", cameras, "--size", f"{size[0]}x{size[1]}", *options)


def camera():
    return server.camera(CAMERAS)


def check_door(at):
    frame = json.dumps({"camera": camera()}).encode()
    for method, path, body in (("GET", "/scene", None), ("POST", "/frame", frame), ("POST", "/pixel", frame), ("POST", "/scene?name=x", b"x")):
        refused(ask(at, method, path, body, token=False), 403)
        refused(ask(at, method, path, body, **{"X-Splat-Token": at.fragment[:-1] + "g"}), 403)
        refused(ask(at, method, path, body, Host="evil.example"), 403)
        refused(ask(at, method, path, body, Host=f"evil.example:{at.port}"), 403)
        refused(ask(at, method, path, body, Origin="http://evil.example"), 403)
        refused(ask(at, method, path, body, Origin=f"http://127.0.0.1:{at.port + 1}"), 403)
        if method == "POST":
            refused(ask(at, method, path, body, Origin=None), 403)
    refused(ask(at, "GET", "/", Host="evil.example"), 403)
    refused(ask(at, "OPTIONS", "/frame", token=False), 403)
    # The page itself holds no secret.
    status, page, headers = ask(at, "GET", "/", token=False)
    assert status == 200 and at.fragment.encode() not in page
    assert "frame-ancestors 'none'" in headers["Content-Security-Policy"] and headers["Access-Control-Allow-Origin"] is None
    refused(ask(at, "GET", "/none"), 404)
    refused(ask(at, "POST", "/frame", b"{"), 400)
    refused(ask(at, "POST", "/frame", b"[" * 60000), 400)
    refused(ask(at, "POST", "/frame", json.dumps({"camera": camera() | {"width": 100000}}).encode()), 400)
    refused(ask(at, "POST", "/scene?name=x.ply", b"no scene"), 400)
    answer = ask(at, "POST", "/scene?name=x.ply", **{"Content-Length": str(2**30 + 1)})
    refused(answer, 413)
    assert json.loads(answer[1])["error"] == f"the request's body is too large, expected at most {2**30} bytes", answer
    refused(ask(at, "POST", "/frame", **{"Content-Length": str(2**16 + 1)}), 413)
    print("the server keeps its door")


def rendered(*words):
    """The picture of `splat render` and its report."""
    picture, report = os.path.join(FOLDER, "p.png"), os.path.join(FOLDER, "p.json")
    subprocess.run(["splat", "render", SCENE, *words, "-o", picture, "--json", report], check=True, stdout=subprocess.DEVNULL)
    with open(report, encoding="utf-8") as f:
        return picture, json.load(f)


def is_picture(pixels, size, picture):
    """Whether rows of red, green, blue and alpha are the picture in the file."""
    ours = os.path.join(FOLDER, "ours.png")
    png_file.write(ours, [pixels[4 * size[0] * y:4 * size[0] * (y + 1)] for y in range(size[1])], 4)
    report = os.path.join(FOLDER, "same.json")
    subprocess.run(["splat", "compare", ours, picture, "--json", report], check=True, stdout=subprocess.DEVNULL)
    with open(report, encoding="utf-8") as f:
        return json.load(f)["equal"]


def check_frame(at):
    """The server's picture is that of `splat render`, and its cycles are those of --time. The scene is activated once."""
    picture, wanted = rendered("--cameras", CAMERAS, "--view", "front", "--time")
    asked = {"camera": camera(), "clock": True, "compare": True}
    facts, pixels = frame(at, asked)
    assert is_picture(pixels, (facts["width"], facts["height"]), picture)
    assert [s["name"] for s in facts["stages"]].count("activate") == 1, facts["stages"]
    nearer = camera() | {"fx": 1.5 * camera()["fx"]}
    stages = [s["name"] for s in frame(at, {"camera": nearer})[0]["stages"]]
    assert "project" in stages and "activate" not in stages and "upload" not in stages, stages
    assert facts["cycles"] == wanted["time"]["sum"]["cycles"], (facts["cycles"], wanted["time"])
    assert facts["error"]["psnr_db"] > 80, facts["error"]
    # What a pixel is made of gives its colour.
    x, y = facts["width"] // 2, facts["height"] // 2
    status, answer, _ = ask(at, "POST", "/pixel", json.dumps(asked | {"x": x, "y": y}).encode())
    assert status == 200, answer
    pixel = json.loads(answer)
    assert pixel["gaussians"] and all(g["tiles"] > 0 and g["pixels"] > 0 for g in pixel["gaussians"])
    for mine, theirs, byte in zip(pixel["machine"], pixel["reference"], pixels[4 * (y * facts["width"] + x):]):
        assert abs(mine - theirs) < 1e-4 and abs(max(0, min(1, mine)) * 255 - byte) < 0.51, pixel


def check_lenses():
    """Cameras of several lenses in turn: the pictures and cycles of `splat render`, and the reference's."""
    own = os.path.join(LENSES, "own.json")
    with viewer(cameras=own) as at:
        scene = json.loads(ask(at, "GET", "/scene")[1])
        assert scene["through_lens"]
        for name, is_choice in (("opencv", True), ("opencv_fisheye", True), ("full_opencv", True), ("nerfstudio-sphere", False)):
            shown, = (c for c in scene["cameras"] if c["name"] == name)
            assert shown["lens_is_a_choice"] == is_choice, shown
            picture, wanted = rendered("--cameras", own, "--view", name, "--time")
            asked = {"camera": shown, "clock": True, "compare": True}
            facts, pixels = frame(at, asked)
            assert is_picture(pixels, (facts["width"], facts["height"]), picture), name
            assert facts["cycles"] == wanted["time"]["sum"]["cycles"], name
            assert facts["error"]["psnr_db"] > 80, (name, facts["error"])
            pixel = json.loads(ask(at, "POST", "/pixel", json.dumps(asked | {"x": facts["width"] // 2, "y": facts["height"] // 2}).encode())[1])
            assert pixel["gaussians"] and all(0 <= g["index"] < scene["gaussians"] for g in pixel["gaussians"]), name
        refused(ask(at, "POST", "/frame", json.dumps({"camera": shown | {"lens": {"camera_model": "ORANGE"}}}).encode()), 400)
        refused(ask(at, "POST", "/frame", json.dumps({"camera": shown | {"lens": []}}).encode()), 400)
    print("lenses are drawn")


def check_switch():
    """On the page of a capture, a switch shows the photograph's camera through its lens."""
    capture = os.path.join(LENSES, "opencv")
    straight = os.path.join(FOLDER, "straight.png")
    picture, report = rendered("--cameras", capture)
    os.replace(picture, straight)
    bent, _ = rendered("--cameras", capture, "--distorted")
    size = report["resolution"]
    with viewer(cameras=capture, size=size) as at:
        browser = Browser(FOLDER)
        try:
            browser.open(at.geturl())
            browser.wait("document.documentElement.dataset.drawn !== undefined")
            rest(browser)

            def shows(picture):
                return is_picture(bytes(map(int, pixels_of(browser).split(","))), size, picture)

            switch = "document.getElementById('lens')"
            assert browser.value(f"[{switch}.parentElement.hidden, {switch}.disabled, {switch}.checked].join()") == "false,false,false"
            assert shows(straight)
            settled(browser, lambda: browser.key("t"))
            assert browser.value(f"{switch}.checked") and shows(bent)
            # One moves through the lens, too, and comes back.
            settled(browser, lambda: browser.key("ArrowLeft"))
            assert not shows(bent)
            settled(browser, lambda: browser.key("r"))
            assert shows(bent)
            settled(browser, lambda: browser.value(f"{switch}.click()"))
            assert shows(straight)
        finally:
            browser.close()
    with viewer("--distorted", cameras=capture) as at:
        assert json.loads(ask(at, "GET", "/scene")[1])["through_lens"]
    print("the switch works")


def rest(browser):
    browser.wait("document.documentElement.dataset.drawn === String(window.seen = document.documentElement.dataset.drawn) "
                 "&& document.getElementById('status').textContent.startsWith('whole picture')")


def pixels_of(browser, side="a"):
    return browser.value(f"(c => Array.from(c.getContext('2d').getImageData(0, 0, c.width, c.height).data).join())"
                         f"(document.querySelector('#view-{side} canvas'))")


def choose(browser, name, value):
    browser.value(f"(e => {{ e.value = '{value}'; e.dispatchEvent(new Event('change')); }})(document.getElementById('{name}'))")


def settled(browser, act):
    """After `act` and everything that follows from it."""
    before = browser.value("document.documentElement.dataset.drawn")
    act()
    browser.wait(f"document.documentElement.dataset.drawn !== '{before}' && document.getElementById('status').textContent.startsWith('whole picture')")


def check_motions(browser, drag, centre):
    """Flying turns the eye where it is, orbiting takes it elsewhere; two fingers that part bring it nearer."""
    browser.value("(send => { window.fetch = (path, options) => { if (path === 'frame') window.eye = JSON.parse(options.body).camera; "
                  "return send(path, options); }; })(window.fetch)")

    def eye():
        return browser.value("window.eye")

    settled(browser, lambda: browser.key("r"))
    start = eye()
    for moves in (True, False):
        settled(browser, drag)
        assert (eye()["position"] != start["position"]) == moves and eye()["rotation"] != start["rotation"], (moves, eye(), start)
        settled(browser, lambda: browser.key("r"))
        assert eye() == start
        browser.key("f")
        assert browser.value("document.querySelector('[name=motion]:checked').value") == ("fly" if moves else "orbit")

    def pinch():
        x, y = centre
        browser.touch("touchStart", (x - 20, y), (x + 20, y))
        for apart in (30, 40, 50, 60):
            browser.touch("touchMove", (x - apart, y), (x + apart, y))
        browser.touch("touchEnd")

    settled(browser, pinch)
    moved = [there - here for there, here in zip(eye()["position"], start["position"])]
    ahead = [row[2] for row in start["rotation"]]
    along = sum(m * a for m, a in zip(moved, ahead))
    aside = math.sqrt(max(0, sum(m * m for m in moved) - along * along))
    assert along > 0 and aside < 0.01 * along and eye()["rotation"] == start["rotation"], (moved, ahead)
    settled(browser, lambda: browser.key("r"))


def check_page(at):
    browser = Browser(FOLDER)
    try:
        browser.shape(1200, 900)
        browser.open(at.geturl())
        browser.wait("document.documentElement.dataset.drawn !== undefined")
        first = pixels_of(browser)
        assert len(set(first.split(","))) > 16, "the picture shows nothing"
        assert browser.value("document.querySelector('#view-a canvas').width") == SIZE[0]
        assert "cycles of the machine" in browser.value("document.getElementById('facts').innerText")

        # Keys, the mouse, the wheel: each shows something else, and R goes back.
        centre = browser.value("(b => [b.left + b.width / 2, b.top + b.height / 2])(document.querySelector('#view-a canvas').getBoundingClientRect())")

        def drag():
            browser.mouse("mousePressed", *centre)
            browser.mouse("mouseMoved", centre[0] + 40, centre[1] + 10, buttons=1)
            browser.mouse("mouseReleased", centre[0] + 40, centre[1] + 10)

        for act in (lambda: browser.key("ArrowLeft"), drag, lambda: browser.mouse("mouseWheel", *centre, button="none", deltaX=0, deltaY=120),
                    lambda: browser.key("w")):
            settled(browser, act)
            assert pixels_of(browser) != first
            assert browser.value("document.getElementById('camera').value") == ""
            settled(browser, lambda: browser.key("r"))
            assert pixels_of(browser) == first

        check_motions(browser, drag, centre)

        # Every layer, and what its colours stand for.
        for layer in browser.value("[...document.getElementById('layer').options].map(o => o.value)")[1:]:
            settled(browser, lambda layer=layer: choose(browser, "layer", layer))
            assert pixels_of(browser) != first, layer
            assert browser.value("document.querySelector('#view-a .legend').innerText").strip(), layer
        settled(browser, lambda: choose(browser, "layer", "picture"))

        # A click lists Gaussians.
        browser.mouse("mousePressed", *centre)
        browser.mouse("mouseReleased", *centre)
        browser.wait("document.querySelectorAll('#gaussians tbody tr').length > 0")

        # Two settings side by side: another unit has another picture, error and time.
        settled(browser, lambda: browser.key("c"))
        settled(browser, lambda: choose(browser, "knob-exp-b", "poly2"))
        assert pixels_of(browser) == first != pixels_of(browser, "b")
        captions = browser.value("[...document.querySelectorAll('figcaption')].map(c => c.innerText)")
        assert "default" in captions[0] and "exp=poly2" in captions[1] and all("cycles" in c and "dB" in c for c in captions), captions
        assert "SH" not in browser.value("document.getElementById('problem').innerText")

        # What is no scene is said, and the old one stays; a scene opens.
        drop = ("(bytes => {{ const t = new DataTransfer(); t.items.add(new File([bytes], '{}')); "
                "document.dispatchEvent(new DragEvent('drop', {{ dataTransfer: t, bubbles: true }})); }})({})")
        browser.value(drop.format("bad.ply", "'no scene'"))
        assert "bad.ply" in browser.wait("document.getElementById('problem').innerText")
        assert pixels_of(browser) == first
        # So is what is too large, before it is sent.
        browser.value("Object.defineProperty(File.prototype, 'size', { get: () => 2 ** 30 + 1, configurable: true }); 0")
        browser.value(drop.format("large.ply", "'much'"))
        browser.wait("document.getElementById('problem').innerText.includes('large.ply: a file of 1025 MiB is too large, expected at most 1024 MiB')")
        browser.value("delete File.prototype.size")
        assert pixels_of(browser) == first
        settled(browser, lambda: browser.key("c"))
        with open(SCENE, "rb") as f:
            content = list(f.read())
        settled(browser, lambda: browser.value(drop.format("again.ply", f"Uint8Array.from({content})")))
        assert browser.value("document.title") == "again.ply"
        assert browser.value("document.getElementById('problem').hidden")

        # The files of a SOG folder are sent as one zip.
        with zipfile.ZipFile(SOG) as sog:
            files = [[name, list(sog.read(name))] for name in sog.namelist()]
        opened = browser.value(f"(async () => {{ const {{ zip }} = await import('./drop.js'), {{ openScene }} = await import('./api.js'); "
                               f"return await openScene('folder', zip({files}.map(([n, b]) => [n, Uint8Array.from(b)]))); }})()")
        assert opened["format"] == "sog" and opened["gaussians"] > 0, opened

        # On a phone nothing is wider than the screen; dark and light differ.
        colours = []
        for scheme in ("light", "dark"):
            browser.shape(400, 800, scheme, mobile=True)
            assert browser.value("document.documentElement.scrollWidth") <= 400
            colours.append(browser.value("getComputedStyle(document.body).backgroundColor"))
        assert colours[0] != colours[1]
        browser.screenshot(os.path.join(FOLDER, "phone.png"))
        assert not browser.complaints or all("400" in json.dumps(c) for c in browser.complaints), browser.complaints
    finally:
        browser.close()
    print("the page works")


with viewer() as at:
    busy = subprocess.run(["splat", "view", SCENE, "--port", str(at.port)], stderr=subprocess.PIPE, text=True, check=False)
    assert busy.returncode == 2 and f"--port {at.port}: is in use" in busy.stderr and busy.stderr.count("\n") == 1, busy
    check_door(at)
    check_frame(at)
    check_page(at)
check_lenses()
check_switch()
