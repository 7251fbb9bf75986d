#!/usr/bin/env python3
"""Writes a mesh as a Wavefront OBJ, with colours at its vertices.

usage: mesh.py ball|floor|near|sliver FILE.obj, or mesh.py textured FILE.gltf
ball: a sphere of 24 x 12 quadrilaterals about (0, 0, 2) with radius 0.7
floor: a ball, and two triangles below it that reach from far behind the camera to far in front
near: a box around the camera of scene.py, whose triangles all cross the near plane or the guard band
sliver: a triangle fan of needles, triangles without area, and a triangle that is not in the picture
textured: a ball with normals and a floor, each with the picture FILE.png of 24 x 10 texels, and squares that sample it by
  other rules
"""

import base64
import json
import math
import os
import random
import struct
import sys

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, os.pardir, "Inputs"))
import png_file


def ball(radius=0.7, centre=(0, 0, 2), columns=24, rows=12):
    lines, faces = [], []
    for row in range(rows + 1):
        for column in range(columns):
            up, around = math.pi * row / rows, 2 * math.pi * column / columns
            unit = (math.sin(up) * math.cos(around), math.cos(up), math.sin(up) * math.sin(around))
            lines.append([c + radius * u for c, u in zip(centre, unit)] + [0.5 + 0.5 * u for u in unit])
    for row in range(rows):
        for column in range(columns):
            right = (column + 1) % columns
            faces.append([1 + r * columns + c for r, c in ((row, column), (row, right), (row + 1, right),
                                                           (row + 1, column))])
    return lines, faces


def floor():
    lines, faces = ball()
    first = len(lines) + 1
    lines += [[x, 0.8, z, (x > 0) * 1.0, 0.25, (z > 0) * 1.0] for x, z in ((-900, -300), (900, -300), (900, 5000),
                                                                          (-900, 5000))]
    return lines, faces + [[first, first + 1, first + 2], [first, first + 2, first + 3]]


def near():
    corners = [[x, y, z] for x in (-0.25, 0.3) for y in (-0.2, 0.22) for z in (-1, 3)]
    quads = [(0, 1, 3, 2), (4, 5, 7, 6), (0, 1, 5, 4), (2, 3, 7, 6), (1, 3, 7, 5), (0, 2, 6, 4)]
    colours = [[(i >> k & 1) * 0.75 for k in range(3)] for i in range(8)]
    return [c + k for c, k in zip(corners, colours)], [[1 + i for i in quad] for quad in quads]


def sliver():
    lines = [[-0.5, -0.3, 1.5, 1, 1, 1]]
    for i in range(40):
        lines.append([0.8, -0.3 + 0.0007 * i * i, 1 + 0.03 * i, i / 40, 1 - i / 40, 0.5])
    faces = [[1, i + 2, i + 3] for i in range(39)]
    return lines + [[9, 9, 1, 0, 0, 0], [9.5, 9, 1, 0, 0, 0], [9, 9.5, 1, 0, 0, 0]], faces + [
        [1, 1, 1], [1, 2, 2], [42, 43, 44], [3, 5, 3]]


def sphere_parts(columns=24, rows=12):
    """A ball of radius 0.6 about (-0.5, 0, 2.2): places with normals and texture coordinates, and triangles."""
    corners, triangles = [], []
    for row in range(rows + 1):
        for column in range(columns + 1):
            up, around = math.pi * row / rows, 2 * math.pi * column / columns
            unit = (math.sin(up) * math.cos(around), math.cos(up), math.sin(up) * math.sin(around))
            corners.append(([c + 0.6 * u for c, u in zip((-0.5, 0, 2.2), unit)], unit,
                            (3 * column / columns, 2 * row / rows)))
    wide = columns + 1
    for row in range(rows):
        for column in range(columns):
            a = row * wide + column
            triangles += [a, a + 1, a + wide, a + 1, a + wide + 1, a + wide]
    return corners, triangles


def square_parts(centre, size, repeat, flat=False):
    """A square, upright or (flat) a floor."""
    corners = []
    for u, v in ((0, 0), (1, 0), (1, 1), (0, 1)):
        x, y = size * (2 * u - 1), size * (2 * v - 1)
        place = (x, 0, -y) if flat else (x, y, 0)
        corners.append(([c + p for c, p in zip(centre, place)], (0, 0, 0), (repeat * u - 0.3, repeat * v - 0.3)))
    return corners, [0, 1, 2, 0, 2, 3]


def textured(path):
    picture = os.path.splitext(path)[0] + ".png"
    values = random.Random(5)
    png_file.write(picture, [bytes(values.randrange(256) for _ in range(3 * 24)) for _ in range(10)], 3)
    repeat, mirror, clamp, nearest, linear = 10497, 33648, 33071, 9728, 9729
    samplers = [{}, {"wrapS": mirror, "wrapT": clamp, "minFilter": linear, "magFilter": linear},
                {"wrapS": repeat, "wrapT": mirror, "minFilter": 9984, "magFilter": nearest},
                {"wrapS": clamp, "wrapT": repeat, "minFilter": 9985, "magFilter": linear},
                {"wrapS": mirror, "wrapT": repeat, "minFilter": 9986, "magFilter": nearest}]
    parts = [(sphere_parts(), 0), (square_parts((0, 0.7, 20), 30, 40, flat=True), 0)]
    parts += [(square_parts((0.5 * i - 1.2, -0.75, 1.6 + 0.7 * i), 0.25, 3 * i), i) for i in (1, 2, 3, 4)]
    data, views, accessors, primitives = b"", [], [], []

    def add(numbers, kind, component, code):
        nonlocal data
        flat = [n for row in numbers for n in row] if kind != "SCALAR" else numbers
        views.append({"buffer": 0, "byteOffset": len(data), "byteLength": 4 * len(flat)})
        accessors.append({"bufferView": len(views) - 1, "componentType": component, "count": len(numbers), "type": kind})
        data += struct.pack(f"<{len(flat)}{code}", *flat)
        return len(accessors) - 1

    for (corners, triangles), material in parts:
        primitives.append({"attributes": {"POSITION": add([c[0] for c in corners], "VEC3", 5126, "f"),
                                          "NORMAL": add([c[1] for c in corners], "VEC3", 5126, "f"),
                                          "TEXCOORD_0": add([c[2] for c in corners], "VEC2", 5126, "f")},
                           "indices": add(triangles, "SCALAR", 5125, "I"), "material": material})
    materials = [{"pbrMetallicRoughness": {"baseColorTexture": {"index": i}}} for i in range(len(samplers))]
    materials[1]["pbrMetallicRoughness"]["baseColorFactor"] = [1, 0.5, 0.25, 1]
    materials[3]["pbrMetallicRoughness"]["baseColorTexture"]["extensions"] = {
        "KHR_texture_transform": {"offset": [0.1, 0.2], "rotation": 0.5, "scale": [0.5, 2]}}
    document = {"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
                "meshes": [{"primitives": primitives}], "materials": materials, "samplers": samplers,
                "textures": [{"source": 0, "sampler": i} for i in range(len(samplers))],
                "images": [{"uri": os.path.basename(picture)}], "accessors": accessors, "bufferViews": views,
                "buffers": [{"byteLength": len(data),
                             "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}]}
    with open(path, "w") as file:
        json.dump(document, file)


if sys.argv[1] == "textured":
    textured(sys.argv[2])
    sys.exit()
lines, faces = {"ball": ball, "floor": floor, "near": near, "sliver": sliver}[sys.argv[1]]()
with open(sys.argv[2], "w") as file:
    file.writelines("v " + " ".join(f"{n:.9g}" for n in line) + "\n" for line in lines)
    file.writelines("f " + " ".join(map(str, face)) + "\n" for face in faces)
