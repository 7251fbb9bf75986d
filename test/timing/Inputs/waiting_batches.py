"""Two launches: the first starts two ways back through a tile of 48 Gaussians, each of which hands over three batches,
and ends; the second takes them. An agent holds two batches, so in between its rasterizer is at work."""
import numpy as np
import pyopencl as cl

SOURCE = """
#include <vorion_raster.h>

#define COUNT 48
#define SIDE 32

kernel __attribute__((reqd_work_group_size(16, 1, 1))) void leave(
    global uint *gaussians, global uint *list, global float4 *pixels, global uint *last, global float4 *upstream) {
  vx_raster_setup((uint)gaussians, 0.0f, 0, SIDE * sizeof(float4));
  for (int n = 0; n < 2; ++n)
    vx_raster_backward((uint)list, COUNT, 0, 0, SIDE, SIDE, (uint)pixels, (uint)last, (uint)upstream, 0);
}

kernel __attribute__((reqd_work_group_size(16, 1, 1))) void take(global uint *taken) {
  uint count = 0;
  for (int n = 0; n < 2; ++n)
    while (vr_grad_next() != 0)
      ++count;
  uint status = vr_wait();
  if (get_local_id(0) == 0) {
    taken[0] = count;
    taken[1] = status;
  }
}
"""

context = cl.create_some_context(interactive=False)
queue = cl.CommandQueue(context)
program = cl.Program(context, SOURCE).build()


def buffer(words):
    return cl.Buffer(context, cl.mem_flags.READ_WRITE | cl.mem_flags.COPY_HOST_PTR,
                     hostbuf=np.array(words, dtype=np.uint32))


PIXELS = 32 * 32
taken = buffer([0, 0])
# They are held: the rasterizer reads them after `leave` has ended, and where the next launch's own memory lies, and so
# its time, would depend on when they were freed.
drawing = [buffer([0] * count) for count in (16, 48, 4 * PIXELS)] + [buffer([48] * PIXELS), buffer([0] * 4 * PIXELS)]
program.leave(queue, (16,), (16,), *drawing)
program.take(queue, (16,), (16,), taken)
words = np.zeros(2, dtype=np.uint32)
cl.enqueue_copy(queue, words, taken)
print(f"{words[0]} batches, status {words[1]}")
