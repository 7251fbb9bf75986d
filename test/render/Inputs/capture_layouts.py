#!/usr/bin/env python3
"""Captures in the layouts of COLMAP, INRIA, gsplat, nerfstudio, Brush and others, and how splat reads them.

usage: capture_layouts.py FOLDER   writes each layout to FOLDER, and compares `splat info` with the table
"""

import json
import math
import os
import struct
import subprocess
import sys
import zlib

WIDTH, HEIGHT, FOCAL, VIEWS, POINTS = 40, 30, 35.0, 6, 4
NAMES = [f"a{i}.png" for i in range(VIEWS)]
TURNED = b"II*\0\x08\0\0\0\x01\0\x12\x01\x03\0\x01\0\0\0\x06\0\0\0\0\0\0\0"  # EXIF orientation 6


def chunk(kind, content):
    return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))


def png(width, height, exif=b""):
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">2I5B", width, height, 8, 2, 0, 0, 0)) +
            (chunk(b"eXIf", exif) if exif else b"") +
            chunk(b"IDAT", zlib.compress((b"\0" + bytes(range(3 * width))) * height)) + chunk(b"IEND", b""))


def pictures(folder, names=NAMES, size=(WIDTH, HEIGHT), exif=b""):
    return {f"{folder}/{name}": png(*size, exif) for name in names}


def pose(i):
    """Quaternion and translation of COLMAP: on a circle around the origin."""
    half = math.pi * i / VIEWS
    return (math.cos(half), 0, math.sin(half), 0), (0, 0, 3)


def colmap(folder, names=NAMES, camera=None, binary=False, points=True):
    camera = camera or f"PINHOLE {WIDTH} {HEIGHT} {FOCAL} {FOCAL} {WIDTH / 2} {HEIGHT / 2}"
    if binary:
        numbers = [float(v) for v in camera.split()[3:]]
        files = {"cameras": struct.pack("<Qii2Q4d", 1, 1, 1, WIDTH, HEIGHT, *numbers),
                 "images": struct.pack("<Q", len(names)) + b"".join(
                     struct.pack("<i7di", i + 1, *pose(i)[0], *pose(i)[1], 1) + n.encode() + b"\0" + struct.pack("<Q", 0)
                     for i, n in enumerate(names)),
                 "points3D": struct.pack("<Q", POINTS) + b"".join(
                     struct.pack("<Q3d3BdQ", i, i, 0, 0, 9, 9, 9, 0.5, 0) for i in range(POINTS))}
    else:
        files = {"cameras": f"# one\n1 {camera}\n".encode(),
                 "images": "".join("{} {} {} {} {} {} {} {} 1 {}\n\n".format(i + 1, *pose(i)[0], *pose(i)[1], n)
                                   for i, n in enumerate(names)).encode(),
                 "points3D": "".join(f"{i} {i} 0 0 9 9 9 0.5\n" for i in range(POINTS)).encode()}
    if not points:
        del files["points3D"]
    return {f"{folder}/{name}.{'bin' if binary else 'txt'}": content for name, content in files.items()}


def transforms(names=NAMES, folder="images", ply="", frame=None, **keys):
    frames = []
    for i, name in enumerate(names):
        a = 2 * math.pi * i / VIEWS
        matrix = [[math.cos(a), 0, math.sin(a), 3 * math.sin(a)], [0, 1, 0, 0],
                  [-math.sin(a), 0, math.cos(a), 3 * math.cos(a)], [0, 0, 0, 1]]
        frames.append({"file_path": f"{folder}/{name}" if folder else name, "transform_matrix": matrix, **(frame or {})})
    keys = keys or {"w": WIDTH, "h": HEIGHT, "fl_x": FOCAL, "fl_y": FOCAL}
    return json.dumps({**keys, **({"ply_file_path": ply} if ply else {}), "frames": frames}).encode()


def ply(properties, row):
    """A text PLY whose rows are x, y, z and \\p row."""
    header = "".join(f"property {p}\n" for p in ["float x", "float y", "float z", *properties])
    return (f"ply\nformat ascii 1.0\nelement vertex {POINTS}\n{header}end_header\n" +
            "".join(f"{i} 0 0 {row}\n" for i in range(POINTS))).encode()


GAUSSIAN = [f"float {n}" for n in ["f_dc_0", "f_dc_1", "f_dc_2", "opacity", "scale_0", "scale_1", "scale_2",
                                   "rot_0", "rot_1", "rot_2", "rot_3"]]
COLORS = ["uchar red", "uchar green", "uchar blue"]
HALF = (WIDTH // 2, HEIGHT // 2)


def cloud(properties, row):
    return {"transforms.json": transforms(ply="p.ply"), "p.ply": ply(properties, row), **pictures("images")}


def matched(names, files, **more):
    return {**colmap("sparse/0", names, **more), **pictures("images", files)}


# The files, what splat info says, and further options. Views, width, points: those of the reference where it has others.
LAYOUTS = {
    "colmap-text": ({**colmap("sparse/0"), **pictures("images")}, {}),
    "colmap-binary": ({**colmap("sparse/0", binary=True), **pictures("images")}, {}),
    "colmap-sparse": ({**colmap("sparse"), **pictures("images")}, {}),
    "colmap-beside-pictures": ({**colmap("."), **pictures("images")}, {}),
    "colmap-two-models": ({**colmap("sparse/0", NAMES[:2]), **colmap("sparse/1"), **pictures("images")},
                          {"note": "the model sparse/1 with 6 images, the largest of 2"}),
    "nerfstudio-colmap": ({**colmap("colmap/sparse/0"), **pictures("images")}, {"note": "the model colmap/sparse/0"}),
    "nerfstudio-both": ({**colmap("colmap/sparse/0"), "transforms.json": transforms(), **pictures("images")},
                        {"format": "transforms", "points": 0}),
    "inria-before-undistortion": ({**colmap("distorted/sparse/0"), **pictures("input")}, {"note": "pictures in"}),
    "inria-undistorted": ({**colmap("distorted/sparse/0", NAMES[:2]), **colmap("sparse/0"), **pictures("input"),
                           **pictures("images")}, {}),
    "mipnerf360-images-4": ({**colmap("sparse/0"), **pictures("images_4", size=(10, 8))},
                            {"width": 10, "focal": FOCAL / 4, "note": "intrinsics of 6 cameras scaled"}),
    "mipnerf360-option": ({**colmap("sparse/0"), **pictures("images"), **pictures("images_2", size=HALF)},
                          {"width": 20, "focal": FOCAL / 2, "options": ["--images", "images_2"]}),
    "tanks-and-temples": ({**colmap("sparse/0", camera="PINHOLE 81 61 70 70 40 30"), **pictures("images")},
                          {"focal": 70 * 40 / 81, "note": "from 81x61 to 40x30"}),
    "model-of-any-name": ({**colmap("out/model"), **pictures("images")}, {"note": "the model out/model"}),
    "pictures-beside-model": ({**colmap("dense/sparse"), **pictures("dense/images")}, {"note": "the model dense/sparse"}),
    "undistorted-beside-model": ({**colmap("sparse/0", camera="OPENCV 80 60 70 70 40 30 0.1 0 0 0"),
                                 **colmap("dense/0/sparse"), **pictures("dense/0/images")},
                                {"note": "the model dense/0/sparse"}),
    "points-of-ply-alone": ({**colmap("sparse/0", points=False), "sparse/0/points3D.ply": ply(COLORS, "1 2 3"),
                             **pictures("images")}, {}),
    "no-points": ({**colmap("sparse/0", points=False), **pictures("images")}, {"points": 0}),
    "points-without-color": (cloud([], ""), {"format": "transforms"}),
    "points-of-floats": (cloud(["float red", "float green", "float blue"], "0.1 0.5 1"), {"format": "transforms"}),
    "points-of-words": (cloud(["ushort red", "ushort green", "ushort blue"], "1 500 65535"), {"format": "transforms"}),
    "points-of-gaussians": (cloud(GAUSSIAN, "0.1 0.5 1 0 0 0 0 1 0 0 0"), {"format": "transforms"}),
    "backslashes": (matched([f"cam\\{n}" for n in NAMES], [f"cam/{n}" for n in NAMES]),
                    {"note": "6 pictures found with other separators: cam\\a0.png is cam/a0.png"}),
    "backslashes-transforms": ({"transforms.json": transforms([f"images\\{n}" for n in NAMES], ""), **pictures("images")},
                               {"format": "transforms", "points": 0, "note": "6 pictures found with other separators"}),
    "another-extension": (matched([n.replace("png", "JPG") for n in NAMES], NAMES),
                          {"note": "6 pictures found with another file extension: a0.JPG is a0.png"}),
    "another-case": (matched([n.upper() for n in NAMES], NAMES), {"note": "6 pictures found in another case"}),
    "blanks": (matched([f"my%20picture {n}" for n in NAMES], [f"my picture  {n}" for n in NAMES]),
               {"note": "6 pictures found in another case or with other blanks"}),
    "flat-pictures": (matched([f"cam0/{n}" for n in NAMES], NAMES), {"note": "6 pictures found in another folder"}),
    "deep-pictures": (matched(NAMES, [f"day/cam0/{n}" for n in NAMES]), {"note": "6 pictures found in another folder"}),
    "missing-picture": (matched([f"{c}/{n}" for c in "xy" for n in NAMES[:3]], [f"x/{n}" for n in NAMES[:3]] + ["y/a0.png"]),
                        {"views": 4}),
    "exif-turned": ({**colmap("sparse/0"), **pictures("images", size=(HEIGHT, WIDTH), exif=TURNED)},
                    {"note": "6 pictures turned by their EXIF orientation"}),
    "exif-as-stored": ({**colmap("sparse/0"), **pictures("images", exif=TURNED)}, {"note": "used as stored"}),
    "null-mask": ({"transforms.json": transforms(frame={"mask_path": None}), **pictures("images")},
                  {"format": "transforms", "points": 0}),
    "one-photograph": ({**colmap("sparse/0", NAMES[:1]), **pictures("images")}, {"views": 1, "held_out": 0}),
    "two-photographs": ({**colmap("sparse/0", NAMES[:2]), **pictures("images")}, {"views": 2, "held_out": 0}),
    "no-extensions": ({"transforms.json": transforms([n[:-4] for n in NAMES], camera_angle_x=2 * math.atan(WIDTH / 2 / FOCAL)),
                       **pictures("images")}, {"format": "transforms", "points": 0}),
    "synthetic": ({"transforms_train.json": transforms([n[:-4] for n in NAMES], camera_angle_x=2 * math.atan(WIDTH / 2 / FOCAL)),
                   **pictures("images")}, {"format": "nerf-synthetic", "points": 0}),
    "colmap-4-division": ({**colmap("sparse/0", camera=f"DIVISION {WIDTH} {HEIGHT} {FOCAL} {FOCAL} 20 15 -0.1"),
                           **pictures("images")}, {}),
    "colmap-4-fisheye": ({**colmap("sparse/0", camera=f"SIMPLE_FISHEYE {WIDTH} {HEIGHT} {FOCAL} 20 15"),
                          **pictures("images")}, {}),
    "colmap-4-sphere": ({**colmap("sparse/0", camera=f"EQUIRECTANGULAR {WIDTH} {HEIGHT} {WIDTH} {HEIGHT}"),
                         **pictures("images")}, {"focal": WIDTH / 2 / math.pi}),
}

# Exports of other programs, and the tool that each message names.
REFUSED = {
    "polycam": ({"keyframes/corrected_cameras/1.json": b"{}", "keyframes/images/1.jpg": b""}, "ns-process-data polycam"),
    "record3d": ({"metadata": b"{}", "rgbd/0.jpg": b""}, "ns-process-data record3d"),
    "record3d-file": ({"x.r3d": b"PK"}, "ns-process-data record3d"),
    "metashape": ({"cameras.xml": b'<?xml version="1.0"?>\n<document version="2.0">\n <chunk label="1">\n'},
                  "ns-process-data metashape"),
    "realitycapture": ({"cameras.csv": b"#name,x,y,alt,heading,pitch,roll,f,px,py\n"}, "ns-process-data realitycapture"),
    "xgrids": ({"scene.lcc": b"{}", "data.bin": b""}, "splat-transform SCENE.lcc SCENE.ply"),
    "opendronemap": ({"opensfm/reconstruction.json": b"[]"}, "ns-process-data odm"),
    "llff": ({"poses_bounds.npy": b"", "images/a.png": b""}, "COLMAP"),
    "bundler": ({"bundle.out": b"# Bundle file v0.3\n"}, "colmap model_converter"),
    "database": ({"database.db": b"SQLite", **pictures("images")}, "colmap mapper"),
    "photographs": (pictures("."), "splat capture"),
}


def write(folder, files):
    for name, content in files.items():
        path = os.path.join(folder, name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "wb") as file:
            file.write(content)


def main(root):
    for name, (files, expected) in LAYOUTS.items():
        folder = os.path.join(root, name)
        write(folder, files)
        report = os.path.join(root, name + ".json")
        done = subprocess.run(["splat", "info", folder, "--json", report, *expected.get("options", [])],
                              capture_output=True, text=True, check=False)
        assert done.returncode == 0, (name, done.stderr)
        with open(report, encoding="utf-8") as file:
            read = json.load(file)
        views = expected.get("views", VIEWS)
        notes = "; ".join(read["notes"])
        assert read["format"] in (expected.get("format", "colmap-text"), "colmap-binary"), (name, read["format"])
        assert len(read["views"]) == views, (name, len(read["views"]))
        assert sum(v["held_out"] for v in read["views"]) == expected.get("held_out", 1), name
        assert read["points"] == expected.get("points", POINTS), (name, read["points"])
        assert all(v["width"] == expected.get("width", WIDTH) for v in read["views"]), (name, read["views"])
        assert all(abs(v["fx"] - expected.get("focal", FOCAL)) < 1e-3 for v in read["views"]), (name, read["views"])
        assert expected.get("note", "") in notes and (notes == "" or "note" in expected or "options" in expected), (name, notes)
        print(f"{name}: {read['format']}, {views} views, {read['points']} points{'; ' if notes else ''}{notes}")
    print(f"{len(LAYOUTS)} layouts read")
    for name, (files, advice) in REFUSED.items():
        folder = os.path.join(root, name)
        write(folder, files)
        for place in (folder, *(os.path.join(folder, f) for f in files if f.endswith((".xml", ".csv", ".lcc", ".r3d")))):
            done = subprocess.run(["splat", "train", place, "-o", os.path.join(root, "x.ply")], capture_output=True, text=True,
                                  check=False)
            assert done.returncode == 3 and advice in done.stderr and done.stderr.count("\n") == 1, (name, done.stderr)
        done = subprocess.run(["splat", "info", folder], capture_output=True, text=True, check=False)
        assert done.returncode == 3 and advice in done.stderr, (name, done.stderr)
    print(f"{len(REFUSED)} exports refused by name")


if __name__ == "__main__":
    main(sys.argv[1])
