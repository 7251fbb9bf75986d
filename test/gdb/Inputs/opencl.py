"""Runs a kernel whose text has no file."""
import numpy as np
import pyopencl as cl

context = cl.create_some_context(interactive=False)
queue = cl.CommandQueue(context)
program = cl.Program(context, "kernel void twice(global float *a) {\n  uint i = get_global_id(0);\n"
                     "  a[i] = 2 * a[i];\n}\n").build()
buffer = cl.Buffer(context, cl.mem_flags.READ_WRITE, 64)
program.twice(queue, (16,), (16,), buffer)
queue.finish()
print("ran")
