"""Runs kernels of the same name from two programs, and one of another name."""

import numpy as np
import pyopencl as cl

context = cl.create_some_context(interactive=False)
queue = cl.CommandQueue(context)
data = cl.Buffer(context, cl.mem_flags.READ_WRITE, 64)
for body in ("a[i] = 10 * i;", "a[i] = 20 * i;"):
    text = "kernel void same(global int *a) {\n  int i = get_global_id(0);\n  " + body + "\n}\n"
    cl.Program(context, text).build("-cl-opt-disable").same(queue, (16,), (16,), data)
other = "kernel void other(global int *a) {\n  int i = get_global_id(0);\n  a[i] += 1;\n}\n"
cl.Program(context, other).build("-cl-opt-disable").other(queue, (16,), (16,), data)
result = np.empty(16, np.int32)
cl.enqueue_copy(queue, result, data)
print("last:", result[-1])
