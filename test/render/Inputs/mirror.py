"""usage: mirror.py SCENE.ply CAMERAS.json QUAD.obj

Writes Gaussians behind a camera `front`, a quad at depth 3 in front of it, and the camera `back` that is its mirror image
in the quad, whose pictures are mirror images, too.
"""

import json
import random
import struct
import sys

random.seed(3)
names = "x y z f_dc_0 f_dc_1 f_dc_2 opacity scale_0 scale_1 scale_2 rot_0 rot_1 rot_2 rot_3".split()
rows = [[random.uniform(-2, 2), random.uniform(-1.5, 1.5), random.uniform(-3, -0.5), *(random.uniform(-1, 1.5) for _ in range(3)),
         random.uniform(-1, 3), *(random.uniform(-3.5, -1) for _ in range(3)), *(random.gauss(0, 1) for _ in range(4))]
        for _ in range(300)]
with open(sys.argv[1], "wb") as file:
    file.write(f"ply\nformat binary_little_endian 1.0\nelement vertex {len(rows)}\n".encode())
    file.write("".join(f"property float {name}\n" for name in names).encode() + b"end_header\n")
    file.write(b"".join(struct.pack(f"<{len(names)}f", *row) for row in rows))
views = {"front": ([0, 0, 0], [[1, 0, 0], [0, 1, 0], [0, 0, 1]]), "back": ([0, 0, 6], [[-1, 0, 0], [0, 1, 0], [0, 0, -1]])}
with open(sys.argv[2], "w", encoding="utf-8") as file:
    json.dump([{"id": n, "img_name": name, "width": 96, "height": 64, "position": at, "rotation": axes, "fx": 60, "fy": 60}
               for n, (name, (at, axes)) in enumerate(views.items())], file)
with open(sys.argv[3], "w", encoding="utf-8") as file:
    file.write("v -10 -10 3\nv 10 -10 3\nv 10 10 3\nv -10 10 3\nf 1 2 3 4\n")
