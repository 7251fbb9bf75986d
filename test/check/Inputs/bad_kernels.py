"""Kernels with errors, and two without, for the checkers of an OpenCL program."""
import numpy as np
import pyopencl as cl

SOURCE = """
kernel void past_the_end(global const float *table, global float *out) {
  out[get_global_id(0)] = table[get_global_id(0) + 4];
}
kernel void never_written(global const float *input, global float *out) {
  out[get_global_id(0)] = input[get_global_id(0)];
}
kernel void neighbours(global float *data) {
  int i = get_global_id(0);
  data[i] = data[i ^ 1] + 1.0f;
}
kernel void copied(global const float *table, global float *out) {
  local float own[16];
  event_t copy = async_work_group_copy(own, table + 16 * get_group_id(0), 16, 0);
  wait_group_events(1, &copy);
  out[get_global_id(0)] = own[15 - get_local_id(0)];
}
kernel void components(global float4 *out) {
  int i = get_global_id(0);
  switch (i & 3) {
  case 0: out[i / 4].x = i; break;
  case 1: out[i / 4].y = i; break;
  case 2: out[i / 4].z = i; break;
  default: out[i / 4].w = i;
  }
}
"""

context = cl.create_some_context(interactive=False)
queue = cl.CommandQueue(context)
program = cl.Program(context, SOURCE).build()
host = np.arange(64, dtype=np.float32)
table = cl.Buffer(context, cl.mem_flags.READ_WRITE | cl.mem_flags.COPY_HOST_PTR, hostbuf=host)
fresh = cl.Buffer(context, cl.mem_flags.READ_WRITE, host.nbytes)
out = cl.Buffer(context, cl.mem_flags.READ_WRITE, host.nbytes)
program.past_the_end(queue, (64,), (16,), table, out)
program.never_written(queue, (64,), (16,), fresh, out)
cl.enqueue_copy(queue, fresh, host)
program.never_written(queue, (64,), (16,), fresh, out)
program.neighbours(queue, (64,), (16,), table)
queue.finish()
print("without errors", flush=True)
program.copied(queue, (64,), (16,), table, out)
program.components(queue, (64,), (16,), cl.Buffer(context, cl.mem_flags.READ_WRITE, host.nbytes))
queue.finish()
print("done")
