"""A kernel whose stack no machine has."""
import numpy as np
import pyopencl as cl

context = cl.create_some_context(interactive=False)
queue = cl.CommandQueue(context)
program = cl.Program(context, """
kernel void deep(global int *o, int n) {
  int a[4000000];
  for (int i = 0; i < n; i += 4099)
    a[i] = i;
  o[0] = a[n / 2];
}""").build()
word = cl.Buffer(context, cl.mem_flags.READ_WRITE, 4)
try:
    program.deep(queue, (16,), (16,), word, np.int32(9)).wait()
except cl.RuntimeError as error:
    print(f"status {error.code}")
