"""Builds a program with a header that is a program, too, and runs its kernel."""
import numpy as np
import pyopencl as cl

context = cl.create_some_context(interactive=False)
queue = cl.CommandQueue(context)
header = cl.Program(context, "uint factor(uint i) { return 5 * i; }\n")
source = cl.Program(context, '#include "factor.h"\n'
                    "kernel void headed(global uint *out) {\n"
                    "  out[get_global_id(0)] = factor(get_global_id(0));\n}\n")
source.compile(headers=[("factor.h", header)])
program = cl.link_program(context, [source])
out = np.zeros(16, np.uint32)
buffer = cl.Buffer(context, cl.mem_flags.WRITE_ONLY, out.nbytes)
program.headed(queue, (16,), (16,), buffer)
cl.enqueue_copy(queue, out, buffer)
print(out[15])
