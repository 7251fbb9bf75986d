#!/usr/bin/env python3
"""Several pages of one `splat view`, its horizon, and what stays when it ends.

usage: view_pages.py SCENE CAMERAS FOLDER
"""

import concurrent.futures
import json
import os
import signal
import socket
import sys
import threading
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "Inputs"))
from browser import Browser
from viewer import ask, camera, frame, viewer

SCENE, CAMERAS, FOLDER = sys.argv[1:]
AXES = {"x": [1, 0, 0], "-x": [-1, 0, 0], "y": [0, 1, 0], "-y": [0, -1, 0], "z": [0, 0, 1], "-z": [0, 0, -1]}


def clocked(at, page, focal):
    """The status of a request for cycles of a view that nobody has asked for."""
    asked = {"camera": camera(CAMERAS) | {"fx": focal}, "clock": True}
    return ask(at, "POST", "/frame", json.dumps(asked).encode(), **{"X-Splat-Page": page})[0]


def check_pages(at):
    with concurrent.futures.ThreadPoolExecutor(8) as pool:
        # All of them at once, three times: each page gets its cycles.
        answers = [pool.submit(lambda n: [clocked(at, f"page-{n}", 40 + n + 0.1 * turn) for turn in range(3)], n) for n in range(3)]
        assert all(answer.result() == [200] * 3 for answer in answers), [answer.result() for answer in answers]
        # A page's newer request takes the place of its older one, and of nobody else's.
        for focal in range(50, 60):
            old = pool.submit(clocked, at, "a", focal)
            time.sleep(0.02)
            other, new = pool.submit(clocked, at, "b", focal + 0.2), pool.submit(clocked, at, "a", focal + 0.5)
            assert (other.result(), new.result()) == (200, 200)
            if old.result() == 409:
                break
        else:
            assert False, "no request was superseded"
    print("each page gets its cycles")


def check_strangers(at):
    slow = [socket.create_connection(("127.0.0.1", at.port)) for _ in range(200)]
    for connection in slow:
        connection.sendall(b"GET / HT")
    status, page, _ = ask(at, "GET", "/", token=False)
    assert status == 200 and b"<title>splat view" in page
    frame(at, {"camera": camera(CAMERAS)})
    print("slow connections keep nobody waiting")


def roll(rotation, up):
    """How far the camera's right is from the horizon."""
    return abs(sum(row[0] * u for row, u in zip(rotation, up)))


def check_up():
    """--up is what the page turns about, with cameras of a file and without."""
    for axis, up in AXES.items():
        with viewer(SCENE, "--up", axis) as at:
            scene = json.loads(ask(at, "GET", "/scene")[1])
            assert scene["up"] == up, (axis, scene["up"])
            found, = scene["cameras"]
            assert roll(found["rotation"], up) < 1e-9, (axis, found)
    with viewer(SCENE, "--cameras", CAMERAS, "--up", "x") as at:
        assert json.loads(ask(at, "GET", "/scene")[1])["up"] == AXES["x"]
        # Of a scene that is dropped, its Gaussians say what is up.
        with open(SCENE, "rb") as f:
            status, text, _ = ask(at, "POST", "/scene?name=%61gain.ply", f.read())
        dropped = json.loads(text)
        assert status == 200 and dropped["name"] == "again.ply" and dropped["up"] != AXES["x"], dropped
    print("--up is heard")


# Turns in `steps` about each axis, level at first or not; gives the largest roll at the end and the largest step of it.
TURNS = """(async () => {
  const { Eye } = await import('./eye.js');
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const cross = (a, b) => [0, 1, 2].map(i => a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3]);
  // A level camera 10 before the middle of the box.
  const level = (up, middle) => {
    const down = up.map(v => -v), right = cross(down, Math.abs(up[2]) < 0.7 ? [0, 0, 1] : [0, 1, 0]);
    const forward = cross(right, down);
    return { width: 96, height: 64, fx: 80, fy: 80, cx: 48, cy: 32, position: middle.map((v, i) => v - 10 * forward[i]),
      rotation: [0, 1, 2].map(i => [right[i], down[i], forward[i]]) };
  };
  const all = [];
  for (const up of UPS) for (const tilt of [0, 0.4, -0.4]) {
    const box = [[-1, -2, -3], [3, 2, 1]];
    const eye = new Eye(level(up, [1, 0, -1]), box, { width: 96, height: 64 }, up);
    const { right, down } = eye, c = Math.cos(tilt), s = Math.sin(tilt);
    eye.right = right.map((v, i) => c * v + s * down[i]);
    eye.down = down.map((v, i) => c * v - s * right[i]);
    const roll = () => Math.asin(dot(eye.right, up));
    let largest = 0, before = roll();
    const begins = Math.abs(before), looked = eye.position.map((v, i) => v + eye.distance * eye.forward[i]);
    for (let n = 0; n < 200; ++n) {
      eye.turn(0.05, n % 50 < 25 ? 0.08 : -0.08, true);
      largest = Math.max(largest, Math.abs(roll() - before));
      before = roll();
    }
    const looks = eye.position.map((v, i) => v + eye.distance * eye.forward[i]);
    all.push({ begins, ends: Math.abs(before), largest, moved: Math.hypot(...looks.map((v, i) => v - looked[i])),
      skew: Math.abs(dot(eye.right, eye.forward)) + Math.abs(dot(eye.right, eye.down)) });
  }
  return all;
})()"""


def check_horizon():
    with viewer(SCENE, "--up", "y", "--size", "96x64") as at:
        browser = Browser(FOLDER)
        try:
            browser.open(at.geturl())
            browser.wait("document.documentElement.dataset.drawn !== undefined")
            for turned in browser.value(TURNS.replace("UPS", json.dumps([*AXES.values(), [0.6, 0.8, 0]]))):
                assert turned["ends"] < 1e-9 and turned["moved"] < 1e-9 and turned["skew"] < 1e-9, turned
                assert turned["begins"] < 1e-9 or abs(turned["begins"] - 0.4) < 1e-9, turned
                # A horizon that was not level becomes so without a jump.
                assert turned["largest"] < 0.1, turned
            # The same with the keys.
            browser.value("(send => { window.fetch = (path, options) => { if (path === 'frame') window.eye = JSON.parse(options.body).camera; "
                          "return send(path, options); }; })(window.fetch)")
            for key in ("ArrowLeft", "ArrowUp", "ArrowLeft"):
                browser.key(key, up=False)
                browser.wait("window.before !== (window.before = JSON.stringify(window.eye)) && window.eye")
                time.sleep(0.3)
                browser.key(key, down=False)
            browser.wait("document.getElementById('status').textContent.startsWith('whole picture')")
            eye = browser.value("window.eye")
            assert roll(eye["rotation"], AXES["y"]) < 1e-9, eye
            browser.screenshot(os.path.join(FOLDER, "level.png"))
            assert not browser.complaints, browser.complaints
        finally:
            browser.close()
    print("the horizon stays level")


def check_ends():
    """No temporary file stays, even of a measurement that goes on."""
    temporary = os.path.join(FOLDER, "temporary")
    os.mkdir(temporary)
    for number in (signal.SIGHUP, signal.SIGINT, signal.SIGTERM):
        signal.signal(number, signal.SIG_DFL)
        with viewer(SCENE, "--cameras", CAMERAS, ends_by=number, TMPDIR=temporary) as at:
            def measure(at=at):
                try:
                    clocked(at, "a", 61)
                except OSError:
                    pass  # the server ends first
            measured = threading.Thread(target=measure)
            measured.start()
            while not any("report" in name or "cameras" in name for _, _, names in os.walk(temporary) for name in names):
                time.sleep(0.01)
        measured.join()
        assert not os.listdir(temporary), (number, os.listdir(temporary))
    print("nothing stays")


with viewer(SCENE, "--cameras", CAMERAS) as running:
    check_pages(running)
    check_strangers(running)
check_up()
check_horizon()
check_ends()
