#!/usr/bin/env python3
"""What a small kernel costs from source to its first run in one process: milliseconds of processor time, user and
system, of the process with PoCL and of the compiler's processes. The kernel cache is off.

usage: compile_small.py [--kernels N]

Each of the N kernels is another source. The first is shown alone, since it also starts PoCL and reads its headers.
Needs scripts/env.sh and PyOpenCL.
"""

import argparse
import os
import resource
import statistics

import command_line

SOURCE = "kernel void f(global float *a) {{ size_t i = get_global_id(0); a[i] = a[i] * {}.5f + 1.0f; }}"


def processor_time():
    """In this process, and in those that it started."""
    return [used.ru_utime + used.ru_stime for used in map(resource.getrusage, (resource.RUSAGE_SELF,
                                                                               resource.RUSAGE_CHILDREN))]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--kernels", type=int, default=60)
    options = parser.parse_args()
    os.environ.update(POCL_KERNEL_CACHE="0", PYOPENCL_NO_CACHE="1")
    import pyopencl as cl # which reads the environment
    context = cl.Context(dev_type=cl.device_type.ALL)
    queue = cl.CommandQueue(context)
    buffer = cl.Buffer(context, cl.mem_flags.READ_WRITE, 4096)
    times = []
    for number in range(options.kernels):
        before = processor_time()
        kernel = cl.Program(context, SOURCE.format(number)).build().f
        kernel(queue, (64,), (16,), buffer).wait()
        times.append([1000 * (after - begun) for after, begun in zip(processor_time(), before)])
    print(f"{'':8}{'PoCL':>8}{'compiler':>10}{'all':>8}  ms")
    for name, rows in (("first", times[:1]), ("others", times[1:])):
        parts = [statistics.median(part) for part in zip(*rows)]
        print(f"{name:8}{parts[0]:8.1f}{parts[1]:10.1f}{statistics.median(map(sum, rows)):8.1f}")


if __name__ == "__main__":
    command_line.run(main)
