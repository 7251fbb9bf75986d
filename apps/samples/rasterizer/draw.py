"""Three Gaussians, drawn by the rasterizer: a host program in Python. usage: draw.py KERNEL PICTURE"""
import sys

import numpy as np
import pyopencl as cl

WIDTH, HEIGHT, TILE = 160, 120, 64
TILES = -(-WIDTH // TILE) * -(-HEIGHT // TILE)

# vx_gaussian of docs/isa.md: 48 bytes.
GAUSSIAN = np.dtype([("mean", "<f4", 2), ("conic", "<f4", 3), ("opacity", "<f4"), ("color", "<f4", 3),
                     ("extent", "<f4", 2), ("tag", "<u4")])
# 1 / 20^2 is a standard deviation of 20 pixels; the box ends at three.
gaussians = np.array([((60, 50), (1 / 400, 0, 1 / 400), 0.9, (1, 0.2, 0.1), (60, 60), 0),
                      ((100, 50), (1 / 400, 0, 1 / 400), 0.9, (0.2, 1, 0.1), (60, 60), 1),
                      ((80, 80), (1 / 900, 0, 1 / 100), 0.9, (0.1, 0.3, 1), (90, 30), 2)], dtype=GAUSSIAN)
front_to_back = np.arange(len(gaussians), dtype=np.uint32)

context = cl.create_some_context(interactive=False)
queue = cl.CommandQueue(context)
with open(sys.argv[1], encoding="utf-8") as file:
    program = cl.Program(context, file.read()).build()


def buffer(values):
    return cl.Buffer(context, cl.mem_flags.READ_WRITE | cl.mem_flags.COPY_HOST_PTR, hostbuf=values)


pixels = np.zeros((HEIGHT, WIDTH, 4), dtype=np.float32)
statuses = np.zeros(TILES, dtype=np.uint32)
picture, status = buffer(pixels), buffer(statuses)
# A group of 16 work-items, which is one warp, for each tile.
program.draw(queue, (16 * TILES,), (16,), buffer(gaussians), buffer(front_to_back), np.uint32(len(gaussians)),
             np.uint32(WIDTH), np.uint32(HEIGHT), picture, status)
cl.enqueue_copy(queue, pixels, picture)
cl.enqueue_copy(queue, statuses, status)

if statuses.any():
    sys.exit(f"draw.py: error: tiles ended with status {statuses}")
with open(sys.argv[2], "wb") as file:
    file.write(b"P6 %d %d 255\n" % (WIDTH, HEIGHT))
    file.write((255 * pixels[:, :, :3] + 0.5).astype(np.uint8).tobytes())
red, green, blue, behind = pixels[HEIGHT // 2, WIDTH // 2]
print(f"{TILES} tiles, all well")
print(f"pixel ({WIDTH // 2}, {HEIGHT // 2}): red {red:.4f}, green {green:.4f}, blue {blue:.4f}, "
      f"light from behind {behind:.4f}")
