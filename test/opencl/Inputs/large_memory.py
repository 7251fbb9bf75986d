"""Three buffers of 900 MiB, touched here and there: one of them lies behind the program's image."""
import numpy as np
import pyopencl as cl

SOURCE = """
#pragma OPENCL EXTENSION cl_khr_byte_addressable_store : enable

uint stored(uint *word, uint value) { return *word = value; }

kernel void spread(global uint *words, uint stride, local uint *counts, global uint *sum, global uint *spaces) {
  size_t item = get_global_id(0);
  uint own = 0;
  words[item * stride] = stored(&own, item + 1);
  counts[get_local_id(0)] = words[item * stride];
  atomic_add(sum, counts[get_local_id(0)]);
  uint *word = words + item * stride;
  atomic_xor(sum + 1, stored(word, *word));
  spaces[item] = (to_global(word) != 0) | (to_local(word) != 0) << 1 | (to_private(&own) == &own) << 2 |
                 (to_global(&own) != 0) << 3 | (to_local(counts) != 0) << 4;
}
"""
BYTES = 900 << 20
ITEMS = 1000
STRIDE = BYTES // 4 // ITEMS

context = cl.create_some_context(interactive=False)
device = context.devices[0]
queue = cl.CommandQueue(context)
print(f"memory {device.global_mem_size >> 20} MiB, an object at most {device.max_mem_alloc_size >> 20} MiB")
program = cl.Program(context, SOURCE).build(options=["-cl-std=CL3.0"])
buffers = [cl.Buffer(context, cl.mem_flags.READ_WRITE, BYTES) for _ in range(3)]
spaces = cl.Buffer(context, cl.mem_flags.READ_WRITE, 4 * ITEMS)
want = np.arange(1, ITEMS + 1, dtype=np.uint32)
for number, buffer in enumerate(buffers):
    totals = cl.Buffer(context, cl.mem_flags.READ_WRITE | cl.mem_flags.COPY_HOST_PTR,
                       hostbuf=np.zeros(2, dtype=np.uint32))
    program.spread(queue, (ITEMS,), (20,), buffer, np.uint32(STRIDE), cl.LocalMemory(80), totals, spaces)
    sums, kinds, last = (np.empty(n, dtype=np.uint32) for n in (2, ITEMS, 1))
    cl.enqueue_copy(queue, sums, totals)
    cl.enqueue_copy(queue, kinds, spaces)
    cl.enqueue_copy(queue, last, buffer, src_offset=4 * (ITEMS - 1) * STRIDE)
    right = sums[0] == want.sum() and sums[1] == np.bitwise_xor.reduce(want) and last[0] == ITEMS
    print(f"buffer {number}: sums {'right' if right else sums}, spaces {np.unique(kinds)}")
# From the last, which lies behind the image, to the first.
cl.enqueue_copy(queue, buffers[0], buffers[2], byte_count=1 << 20, src_offset=BYTES - (1 << 20)).wait()
