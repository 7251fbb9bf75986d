#!/usr/bin/env python3
"""Runs `splat view` with meshes, and holds its answers against `splat render` and `splat convert`.

usage: view_mesh.py FOLDER, which has s.ply, c.json, ball.obj, panes.gltf, and mixed.glb of the scene and the panes
"""

import json
import os
import re
import subprocess
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "Inputs"))
import npz_file
import png_file
from browser import Browser
from viewer import ask, camera, frame, refused, viewer

os.chdir(sys.argv[1])
LIGHT = "--light=0.3,-1,0.5"
VIEW = camera("c.json")
WIDTH, HEIGHT = VIEW["width"], VIEW["height"]


def splat(*words):
    subprocess.run(["splat", *words], check=True, stdout=subprocess.DEVNULL)


def same(one, other):
    splat("compare", one, other, "--json", "same.json")
    with open("same.json", encoding="utf-8") as f:
        return json.load(f)["equal"]


def shows(at, *words):
    """Whether the viewer's picture is that of `splat render` with these words; gives its facts, and the report of render."""
    facts, pixels = frame(at, {"camera": VIEW, "clock": True, "compare": True})
    png_file.write("ours.png", [pixels[4 * WIDTH * y:4 * WIDTH * (y + 1)] for y in range(HEIGHT)], 4)
    splat("render", *words, "--cameras", "c.json", "-o", "theirs.png", "--time", "--json", "r.json", "--visible", "v.npz")
    assert same("ours.png", "theirs.png"), words
    with open("r.json", encoding="utf-8") as r:
        report = json.load(r)
    assert facts["error"]["psnr_db"] > 60, facts["error"]
    return facts, report


def pixel(at, x, y):
    status, text, _ = ask(at, "POST", "/pixel", json.dumps({"camera": VIEW, "x": x, "y": y}).encode())
    assert status == 200, text
    made = json.loads(text)
    for mine, theirs in zip(made["machine"], made["reference"]):
        assert abs(mine - theirs) < 1e-4, made
    # Each triangle is between the Gaussians in front of it and behind it, and gets what is left by what is before.
    parts = [(g["depth"], g) for g in made["gaussians"]]
    for t in reversed(made["triangles"]):
        parts.insert(t["in_front"], (t["depth"], t))
    left = 1
    for (depth, part), (behind, _) in zip(parts, parts[1:] + [(1e9, None)]):
        assert depth <= behind and abs(part["weight"] - left * part["alpha"]) < 1e-9, made
        left *= 1 - part["alpha"]
    return made


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def depth_at(corners, x, y):
    """Of a triangle that the pixel's ray must hit; the camera is at the origin and looks along z."""
    assert VIEW["position"] == [0, 0, 0] and VIEW["rotation"] == [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
    ray = [(x + 0.5 - WIDTH / 2) / VIEW["fx"], (y + 0.5 - HEIGHT / 2) / VIEW["fy"], 1]
    normals = [cross(corners[k], corners[(k + 1) % 3]) for k in range(3)]
    sides = [dot(ray, n) for n in normals]
    assert all(s > -1e-3 for s in sides) or all(s < 1e-3 for s in sides), (corners, x, y)
    normal = cross([b - a for a, b in zip(*corners[:2])], [c - a for a, c in zip(corners[0], corners[2])])
    return dot(corners[0], normal) / dot(ray, normal)


def scene(at):
    return json.loads(ask(at, "GET", "/scene")[1])


def command(at, **more):
    status, text, _ = ask(at, "POST", "/command", json.dumps({"camera": VIEW, **more}).encode())
    assert status == 200, text
    return json.loads(text)["command"]


def check_added():
    with open("ball.obj", encoding="utf-8") as f:
        lines = [line.split() for line in f]
    places = [[float(n) for n in line[1:4]] for line in lines if line[0] == "v"]
    faces = [[int(n) - 1 for n in line[1:]] for line in lines if line[0] == "f"]
    with viewer("s.ply", "--cameras", "c.json", "--mesh", "ball.obj", LIGHT) as at:
        facts, report = shows(at, "s.ply", "--mesh", "ball.obj", LIGHT)
        assert facts["cycles"] == report["time"]["sum"]["cycles"], (facts["cycles"], report["time"])
        assert scene(at)["triangles"] == 576 and scene(at)["layers"] == ["picture", "depth", "error"]
        subprocess.run(["bash", "-c", command(at)], check=True, stdout=subprocess.DEVNULL)
        assert same("s-view.png", "theirs.png")
        for layer in ("list", "blends", "cycles", "saturation"):
            refused(ask(at, "POST", "/frame", json.dumps({"camera": VIEW, "layer": layer}).encode()), 400)
        bent = VIEW | {"lens": {"camera_model": "OPENCV_FISHEYE", "k1": 0.1}}
        for path in ("/frame", "/pixel", "/command"):
            refused(ask(at, "POST", path, json.dumps({"camera": bent}).encode()), 400)
        print("pictures are those of render")
        depths = npz_file.arrays("v.npz")["depth"][1]
        for x, y in ((75, 50), (60, 40), (90, 62)):
            made = pixel(at, x, y)
            triangle, = made["triangles"]
            face = faces[triangle["number"] // 2]
            wanted = [face[0], *(face[1:3] if triangle["number"] % 2 == 0 else face[2:4])]
            assert triangle["file"] == "ball.obj" and triangle["part"] == "", triangle
            for place, corner in zip(wanted, triangle["corners"]):
                assert all(abs(a - b) < 1e-5 for a, b in zip(places[place], corner)), triangle
            assert abs(triangle["depth"] - depth_at(triangle["corners"], x, y)) < 1e-4, triangle
            assert abs(triangle["depth"] - depths[y * WIDTH + x]) < 1e-6, triangle
        outside = pixel(at, 2, 2)
        assert not outside["triangles"]
        print("a pixel names its triangle")


def check_own():
    with viewer("mixed.glb", "--cameras", "c.json", "--mesh", "ball.obj") as at:
        shows(at, "mixed.glb", "--mesh", "ball.obj")
        described = scene(at)
        assert described["layers"] == ["picture", "error"] and "ztiles" not in [k["name"] for k in described["knobs"]]
        refused(ask(at, "POST", "/frame", json.dumps({"camera": VIEW, "setting": "ztiles=2"}).encode()), 400)
        counts = []
        for x in range(3, WIDTH, 24):
            made = pixel(at, x, HEIGHT // 2)
            counts.append(len(made["triangles"]))
            for t in made["triangles"]:
                assert abs(t["depth"] - depth_at(t["corners"], x, HEIGHT // 2)) < 1e-3, t
                assert t["file"] in ("mixed.glb", "ball.obj"), t
        assert max(counts) > 1, counts
        assert len(made["point"]) == 3
        print("layers are in their places")

        number = json.loads(ask(at, "GET", "/number")[1])["scene"]
        refused(ask(at, "GET", "/saved?name=x.ply"), 400)
        assert scene(at)["endings"] == [".glb"]
        status, text, _ = ask(at, "POST", "/edit", json.dumps({"do": "delete", "scene": number, "parts": [{"fainter": 0.4}]}).encode())
        assert status == 200, text
        status, saved, _ = ask(at, "GET", "/saved?name=mixed-edited.glb")
        assert status == 200
        with open("mixed-edited.glb", "wb") as f:
            f.write(saved)
        splat("convert", "mixed.glb", "--drop-faint", "0.4", "-o", "made.glb")
        with open("made.glb", "rb") as f:
            assert saved == f.read()
        facts, report = shows(at, "mixed-edited.glb", "--mesh", "ball.obj")
        assert facts["cycles"] == report["time"]["sum"]["cycles"]
        assert " render mixed-edited.glb --mesh ball.obj " in command(at), command(at)
        status, text, _ = ask(at, "POST", "/edit", json.dumps({"do": "undo", "scene": number + 1, "parts": []}).encode())
        assert status == 200, text
        shows(at, "mixed.glb", "--mesh", "ball.obj")
        print("edits keep the mesh")


def check_drop():
    def send(name, content):
        return ask(at, "POST", f"/scene?name={name}", content)

    with open("ball.obj", "rb") as f, open("mixed.glb", "rb") as g:
        ball, mixed = f.read(), g.read()
    with viewer("s.ply", "--cameras", "c.json") as at:
        number = scene(at)["number"]
        for name, content in (("bad.obj", ball + b"f 1 2 9999\n"), ("few.obj", b"v 0 0 0\n"), ("words.txt", b"hello there\n")):
            refused(answer := send(name, content), 400)
            assert json.loads(answer[1])["error"].startswith(name), answer
        assert scene(at)["number"] == number
        status, text, _ = send("ball.obj", b"mtllib none.mtl\n" + ball)
        described = json.loads(text)
        assert status == 200 and described["triangles"] == 576 and described["name"] == "s.ply", text
        warning, = described["warnings"]
        assert warning.startswith("ball.obj:1: "), warning
        shows(at, "s.ply", "--mesh", "ball.obj")
        assert " render s.ply --mesh ball.obj " in command(at)
        # An edit keeps it, and its undoing.
        ask(at, "POST", "/edit", json.dumps({"do": "delete", "scene": number + 1, "parts": [{"fainter": 0.4}]}).encode())
        splat("convert", "s.ply", "--drop-faint", "0.4", "-o", "fewer.ply")
        shows(at, "fewer.ply", "--mesh", "ball.obj")
        # A scene takes the place of both.
        status, text, _ = send("mixed.glb", mixed)
        assert status == 200 and json.loads(text)["triangles"] == 14, text
        shows(at, "mixed.glb")
        counts = [len(pixel(at, x, HEIGHT // 2)["triangles"]) for x in range(3, WIDTH, 24)]
        assert max(counts) > 3, counts
        status, text, _ = send("ball.obj", ball)
        assert status == 200 and json.loads(text)["triangles"] == 590, text
        shows(at, "mixed.glb", "--mesh", "ball.obj")
        print("a mesh is dropped")


def check_page():
    with viewer("mixed.glb", "--cameras", "c.json", "--mesh", "ball.obj", "--size", f"{WIDTH}x{HEIGHT}") as at:
        browser = Browser(os.getcwd())
        try:
            browser.open(at.geturl())
            browser.wait("document.getElementById('status').textContent.startsWith('whole picture')")
            assert "590 triangles" in browser.value("document.getElementById('about').textContent")
            assert browser.value("document.getElementById('warnings').textContent") == ""
            browser.key("Enter")
            said = browser.wait("document.getElementById('triangles').innerText")
            assert re.match(r"triangle \d+ of (ball\.obj|mixed\.glb, .*): corners \(", said), said
            rows = browser.value("document.getElementById('gaussians').innerText")
            assert rows.count("triangle") == said.count("triangle") > 1, (said, rows)
            browser.screenshot("page.png")
            assert not browser.complaints, browser.complaints
        finally:
            browser.close()
        print("the page shows it")


check_added()
check_own()
check_drop()
check_page()
