#!/usr/bin/env python3
"""Writes a mesh with transparent and masked triangles as glTF, with colours and alpha at its vertices.

usage: mesh_layers.py layers|many FILE.gltf
layers: an opaque wall, a tilted quadrilateral with a mask, and five transparent ones, of which two cross and one lies
        in another's plane
many: nine transparent quadrilaterals one behind the other
"""

import base64
import json
import struct
import sys


def quad(near, far, size, colour, alphas, shift=0.0):
    """Depth `near` on the left and `far` on the right; alphas of the four corners."""
    corners = ((-size + shift, -size, near), (size + shift, -size, far), (size + shift, size, far), (-size + shift, size, near))
    return [(*corner, *colour, alpha) for corner, alpha in zip(corners, alphas)]


def layers():
    return {
        "OPAQUE": [quad(2.9, 2.2, 1.2, (0.1, 0.4, 0.1), (1, 1, 1, 1), shift=0.9)],
        "MASK": [quad(1.6, 2.3, 0.6, (0.6, 0.1, 0.5), (0, 1, 1, 0.2))],
        "BLEND": [quad(1.2, 2.6, 0.9, (0.8, 0.2, 0.1), (0.3, 0.8, 0.8, 0)),
                  quad(2.6, 1.2, 0.9, (0.1, 0.2, 0.8), (0.6, 0.1, 0.4, 0.5)),
                  quad(2, 2, 1.1, (0.9, 0.9, 0.2), (0.5, 0.5, 0.5, 0.5), shift=-0.4),
                  quad(2, 2, 0.4, (0.2, 0.9, 0.9), (0.9, 0.9, 0.9, 0.9), shift=-0.4),
                  quad(0.8, 0.9, 0.1, (1, 1, 1), (0.5, 1, 0.5, 0.5))]}


def many():
    return {"BLEND": [quad(1 + 0.2 * k, 1 + 0.2 * k, 0.3, (0.1 * k, 0.5, 0.5), (0.1,) * 4) for k in range(9)]}


data, views, accessors, primitives, materials = b"", [], [], [], []


def accessor(values, kind, component, code):
    global data
    packed = b"".join(struct.pack("<" + code * len(value), *value) for value in values)
    views.append({"buffer": 0, "byteOffset": len(data), "byteLength": len(packed)})
    data += packed
    accessors.append({"bufferView": len(views) - 1, "componentType": component, "count": len(values), "type": kind})
    if kind == "VEC3":
        accessors[-1].update({"min": [min(v[k] for v in values) for k in range(3)],
                              "max": [max(v[k] for v in values) for k in range(3)]})
    return len(accessors) - 1


for mode, quads in {"layers": layers, "many": many}[sys.argv[1]]().items():
    vertices = [vertex for one in quads for vertex in one]
    corners = [(4 * q + c,) for q in range(len(quads)) for c in (0, 1, 2, 0, 2, 3)]
    primitives.append({"attributes": {"POSITION": accessor([v[:3] for v in vertices], "VEC3", 5126, "f"),
                                      "COLOR_0": accessor([v[3:] for v in vertices], "VEC4", 5126, "f")},
                       "indices": accessor(corners, "SCALAR", 5125, "I"), "material": len(materials)})
    materials.append({"alphaMode": mode, "alphaCutoff": 0.45} if mode == "MASK" else {"alphaMode": mode})
with open(sys.argv[2], "w") as file:
    json.dump({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
               "meshes": [{"primitives": primitives}], "materials": materials, "accessors": accessors, "bufferViews": views,
               "buffers": [{"byteLength": len(data),
                            "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}]}, file)
