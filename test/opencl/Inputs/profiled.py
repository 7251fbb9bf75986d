"""Launches a kernel twice; with the argument `profile`, prints how long each launch took.

usage: profiled.py [profile]
"""

import sys

import pyopencl as cl

context = cl.create_some_context(interactive=False)
properties = cl.command_queue_properties.PROFILING_ENABLE if sys.argv[1:] == ["profile"] else 0
queue = cl.CommandQueue(context, properties=properties)
out = cl.Buffer(context, cl.mem_flags.WRITE_ONLY, 256)
program = cl.Program(context, "kernel void fill(global int *out) { out[get_global_id(0)] = get_global_id(0); }").build()
for _ in range(2):
    event = program.fill(queue, (64,), (16,), out)
    event.wait()
    if properties:
        print(f"{(event.profile.end - event.profile.start) / 1e3:.3f} us")
