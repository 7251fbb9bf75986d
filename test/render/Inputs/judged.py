#!/usr/bin/env python3
"""A capture of two views, and a second look at its scores.

usage: judged.py make CAMERAS.json FOLDER     views of the camera, 181x190 pixels, with photographs of noise over a ramp
       judged.py check FOLDER EVAL.json CSV PICTURE.npz...   the scores by their definitions, of pictures a, b, ...
The definitions are written out here: windows of 11x11 weights, no separable sums, no code of the program's.
"""

import csv
import json
import math
import os
import sys

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "Inputs"))
import png_file

WIDTH, HEIGHT = 181, 190


def photograph(number):
    r = np.random.default_rng(number)
    y, x = np.mgrid[0:HEIGHT, 0:WIDTH]
    ramp = np.stack([x, y, x + y], axis=2)
    return (ramp * 200 // ramp.max() + r.integers(0, 56, ramp.shape)).astype(np.uint8)


def make(cameras, folder):
    os.makedirs(folder)
    focal = 130
    frames, views = [], []
    for number, name in enumerate("ab"):
        # At the origin and a little to the right; x right, y up, z back.
        shift = 0.1 * number
        frames.append({"file_path": f"{name}.png", "transform_matrix":
                       [[1, 0, 0, shift], [0, -1, 0, 0], [0, 0, -1, 0], [0, 0, 0, 1]]})
        views.append({"id": number, "img_name": name, "width": WIDTH, "height": HEIGHT, "position": [shift, 0, 0],
                      "rotation": [[1, 0, 0], [0, 1, 0], [0, 0, 1]], "fx": focal, "fy": focal})
        png_file.write(os.path.join(folder, f"{name}.png"), [row.tobytes() for row in photograph(number)], 3)
    with open(os.path.join(folder, "transforms.json"), "w") as f:
        json.dump({"w": WIDTH, "h": HEIGHT, "fl_x": focal, "fl_y": focal, "frames": frames}, f)
    with open(cameras, "w") as f:
        json.dump(views, f)


def weights():
    at = np.arange(-5, 6)
    w = np.exp(-(at[:, None] ** 2 + at[None, :] ** 2) / (2 * 1.5 ** 2))
    return w / w.sum()


def windows(picture):
    """Of each pixel whose window is inside: the weighted mean."""
    height, width = picture.shape
    w = weights()
    return sum(w[i, j] * picture[i:height - 10 + i, j:width - 10 + j] for i in range(11) for j in range(11))


def terms(a, b):
    ma, mb = windows(a), windows(b)
    va, vb = windows(a * a) - ma ** 2, windows(b * b) - mb ** 2
    cov = windows(a * b) - ma * mb
    c1, c2 = 0.01 ** 2, 0.03 ** 2
    return (2 * ma * mb + c1) / (ma ** 2 + mb ** 2 + c1), (2 * cov + c2) / (va + vb + c2)


def ssim(a, b):
    # Zeros beyond the border: windows of a frame of them are those of all pixels.
    mean, structure = terms(np.pad(a, 5), np.pad(b, 5))
    return (mean * structure).mean()


def ms_ssim(a, b):
    result = 1
    for weight in (0.0448, 0.2856, 0.3001, 0.2363, 0.1333):
        mean, structure = terms(a, b)
        last = (mean * structure).mean()
        result *= max(structure.mean() if weight != 0.1333 else last, 0) ** weight
        h, w = a.shape[0] // 2 * 2, a.shape[1] // 2 * 2
        a, b = ((p[:h:2, :w:2] + p[1:h:2, :w:2] + p[:h:2, 1:w:2] + p[1:h:2, 1:w:2]) / 4 for p in (a, b))
    return result


def check(folder, report, table, pictures):
    with open(report) as f:
        said = json.load(f)
    with open(table, newline="") as f:
        rows = list(csv.DictReader(f))
    means = np.zeros(3)
    for number, path in enumerate(pictures):
        levels = np.clip(np.load(path)["render"], 0, 1) * np.float32(255)
        drawn = np.floor(levels.astype(np.float64) + 0.5)
        wanted = photograph(number).astype(np.float64)
        a, b = drawn / 255, wanted / 255
        scores = [10 * math.log10(255 ** 2 / ((drawn - wanted) ** 2).mean()),
                  np.mean([ssim(a[..., c], b[..., c]) for c in range(3)]),
                  np.mean([ms_ssim(a[..., c], b[..., c]) for c in range(3)])]
        means += np.array(scores) / len(pictures)
        view = said["views"][number]
        assert view["resolution"] == [WIDTH, HEIGHT], view
        for key, score in zip(("psnr8_db", "ssim", "ms_ssim"), scores):
            assert abs(view[key] - score) < 1e-9 * max(1, abs(score)), (key, view[key], score)
            assert float(rows[number][key]) == view[key], (key, rows[number])
    both = [said["mean_held_out"], said["mean_in_training"]]
    for key, mean in zip(("psnr8_db", "ssim", "ms_ssim"), means):
        assert abs(sum(m[key] for m in both) / 2 - mean) < 1e-9 * abs(mean), key
    print(f"{len(pictures)} views agree")


if sys.argv[1] == "make":
    make(*sys.argv[2:])
else:
    check(sys.argv[2], sys.argv[3], sys.argv[4], sys.argv[5:])
