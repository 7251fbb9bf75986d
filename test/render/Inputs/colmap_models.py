#!/usr/bin/env python3
"""Small Gaussians through each camera model of COLMAP that splat has: they are where COLMAP's formulas place them.

usage: colmap_models.py FOLDER   writes captures to FOLDER, renders them, and compares centroids
"""

import math
import os
import struct
import subprocess
import sys

WIDTH, HEIGHT = 160, 120
POINTS = [(-0.5, 0.25, 2.0), (0.7, 0.4, 2.5), (0.2, -0.6, 1.8)]  # in the camera's axes; red, green, blue
FX, FY, CX, CY = 90.0, 85.0, 82.0, 57.0
# COLMAP's quaternion w, x, y, z and translation, world to camera.
QUATERNION, TRANSLATION = (0.8, 0.2, -0.4, 0.4), (0.3, -0.2, 0.5)


def opencv(u, v, k1=0, k2=0, p1=0, p2=0, k3=0, k4=0, k5=0, k6=0):
    r = u * u + v * v
    scale = (1 + r * (k1 + r * (k2 + r * k3))) / (1 + r * (k4 + r * (k5 + r * k6)))
    return (u * scale + 2 * p1 * u * v + p2 * (r + 2 * u * u), v * scale + 2 * p2 * u * v + p1 * (r + 2 * v * v))


def fisheye(u, v, *k):
    radius = math.hypot(u, v)
    theta = math.atan(radius)
    distorted = theta * (1 + sum(k_n * theta ** (2 * n + 2) for n, k_n in enumerate(k)))
    return u * distorted / radius, v * distorted / radius


def division(u, v, k):
    """The root d of u = d / (1 + k d^2) that is near u."""
    scale = 2 / (1 + math.sqrt(1 - 4 * k * (u * u + v * v)))
    return u * scale, v * scale


def eucm(u, v, alpha, beta):
    divisor = alpha * math.sqrt(1 + beta * (u * u + v * v)) + 1 - alpha
    return u / divisor, v / divisor


# The parameters after the focal lengths and the principal point, whether there is one focal length, and the formula.
MODELS = {
    "SIMPLE_PINHOLE": (True, [], lambda u, v: (u, v)),
    "PINHOLE": (False, [], lambda u, v: (u, v)),
    "SIMPLE_RADIAL": (True, [-0.1], opencv),
    "RADIAL": (True, [-0.1, 0.03], opencv),
    "OPENCV": (False, [-0.1, 0.03, 0.002, -0.003], opencv),
    "OPENCV_FISHEYE": (False, [0.05, -0.02, 0.004, -0.001], fisheye),
    "FULL_OPENCV": (False, [0.1, 0.03, 0.002, -0.003, 0.01, 0.2, 0.02, 0.003], opencv),
    "SIMPLE_RADIAL_FISHEYE": (True, [0.05], fisheye),
    "RADIAL_FISHEYE": (True, [0.05, -0.02], fisheye),
    "SIMPLE_DIVISION": (True, [-0.15], division),
    "DIVISION": (False, [0.1], division),
    "EUCM": (False, [0.7, 1.4], eucm),
    "SIMPLE_FISHEYE": (True, [], fisheye),
    "FISHEYE": (False, [], fisheye),
}


def world(point):
    """The world's point that the camera has at `point`: R^T (p - t)."""
    w, x, y, z = QUATERNION
    r = [[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
         [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
         [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]
    d = [p - t for p, t in zip(point, TRANSLATION)]
    return [sum(r[i][k] * d[i] for i in range(3)) for k in range(3)]


def write_scene(path):
    names = ["x", "y", "z", "f_dc_0", "f_dc_1", "f_dc_2", "opacity", "scale_0", "scale_1", "scale_2",
             "rot_0", "rot_1", "rot_2", "rot_3"]
    rows = ""
    for i, point in enumerate(POINTS):
        color = [1.7724539 if i == c else -1.7724539 for c in range(3)]
        rows += " ".join(map(str, [*world(point), *color, 3, -4, -4, -4, 1, 0, 0, 0])) + "\n"
    with open(path, "w", encoding="ascii") as file:
        file.write(f"ply\nformat ascii 1.0\nelement vertex {len(POINTS)}\n" + "".join(f"property float {n}\n" for n in names) +
                   "end_header\n" + rows)


def centroids(path):
    with open(path, "rb") as file:
        assert file.readline() == b"PF\n"
        width, height = map(int, file.readline().split())
        file.readline()
        values = struct.unpack(f"<{3 * width * height}f", file.read())
    sums = [[0.0, 0.0, 0.0] for _ in POINTS]
    for y in range(height):
        for x in range(width):
            for c, total in enumerate(sums):
                value = values[3 * ((height - 1 - y) * width + x) + c]
                total[0] += value * (x + 0.5)
                total[1] += value * (y + 0.5)
                total[2] += value
    return [(sx / s, sy / s) for sx, sy, s in sums]


def main(root):
    scene = os.path.join(root, "scene.ply")
    write_scene(scene)
    cases = {name: (f"{name} {WIDTH} {HEIGHT} " + " ".join(map(str, [FX, CX, CY] if one else [FX, FY, CX, CY])) + " " +
                    " ".join(map(str, k)), FX, FX if one else FY, k, formula) for name, (one, k, formula) in MODELS.items()}
    cases["EQUIRECTANGULAR"] = (f"EQUIRECTANGULAR {WIDTH} {HEIGHT} {WIDTH} {HEIGHT}", 0, 0, [], None)
    for name, (camera, fx, fy, k, formula) in cases.items():
        folder = os.path.join(root, name)
        os.makedirs(folder)
        for file, text in (("cameras", f"1 {camera}\n"), ("points3D", ""),
                           ("images", f"1 {' '.join(map(str, QUATERNION))} {' '.join(map(str, TRANSLATION))} 1 a.png\n\n")):
            with open(os.path.join(folder, file + ".txt"), "w", encoding="ascii") as out:
                out.write(text)
        picture = os.path.join(root, name + ".pfm")
        subprocess.run(["splat", "render", scene, "--cameras", folder, "--distorted", "-o", picture], check=True,
                       stdout=subprocess.DEVNULL)
        worst = 0.0
        for (x, y, z), (px, py) in zip(POINTS, centroids(picture)):
            if formula:
                u, v = formula(x / z, y / z, *k)
                wanted = fx * u + CX, fy * v + CY
            else:
                wanted = ((math.atan2(x, z) / (2 * math.pi) + 0.5) * WIDTH,
                          (math.atan2(y, math.hypot(x, z)) / math.pi + 0.5) * HEIGHT)
            worst = max(worst, math.dist((px, py), wanted))
        assert worst < 0.02, (name, worst)
        print(f"{name}: within {worst:.3f} pixels")
    print(f"{len(cases)} camera models agree")


if __name__ == "__main__":
    main(sys.argv[1])
