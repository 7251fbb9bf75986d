#!/usr/bin/env python3
"""What a small kernel costs from source to its first run in one process: milliseconds of processor time, user and
system, of the process with PoCL and of the compiler's processes, and milliseconds that go by. The kernel cache is off.

usage: compile_small.py [--kernels N]

Each of the N kernels is another source. The first is shown alone, since it also starts PoCL and reads its headers.
Of the others the mean is shown: the system counts the time of processes that stay in hundredths of a second.
Needs scripts/env.sh and PyOpenCL.
"""

import argparse
import os
import resource
import statistics
import time

import command_line
import processor_time

SOURCE = "kernel void f(global float *a) {{ size_t i = get_global_id(0); a[i] = a[i] * {}.5f + 1.0f; }}"


# In the environment of what this process starts, so that it is found.
MARK = f"COMPILE_SMALL={os.getpid()}"


def servers_time():
    """Of the tools that stay (runtime/pocl/README.md), and of what they started and waited for."""
    ticks = 0
    for entry in filter(str.isdigit, os.listdir("/proc")):
        try:
            with open(f"/proc/{entry}/environ", "rb") as environment, open(f"/proc/{entry}/stat", encoding="utf-8") as state:
                if MARK.encode() in environment.read().split(b"\0"):
                    ticks += sum(map(int, state.read().rpartition(")")[2].split()[11:15]))
        except OSError: # it has ended
            pass
    return ticks / os.sysconf("SC_CLK_TCK")


def spent():
    """Seconds: of this process, of the compiler's, and those that went by."""
    own = resource.getrusage(resource.RUSAGE_SELF)
    return own.ru_utime + own.ru_stime, sum(processor_time.of_ended()) + servers_time(), time.monotonic()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--kernels", type=int, default=60)
    options = parser.parse_args()
    os.environ.update(POCL_KERNEL_CACHE="0", PYOPENCL_NO_CACHE="1", COMPILE_SMALL=str(os.getpid()))
    processor_time.adopt_orphans()
    import pyopencl as cl # which reads the environment
    context = cl.Context(dev_type=cl.device_type.ALL)
    queue = cl.CommandQueue(context)
    buffer = cl.Buffer(context, cl.mem_flags.READ_WRITE, 4096)
    times = []
    for number in range(options.kernels):
        before = spent()
        kernel = cl.Program(context, SOURCE.format(number)).build().f
        kernel(queue, (64,), (16,), buffer).wait()
        times.append([1000 * (after - begun) for after, begun in zip(spent(), before)])
    print(f"{'':8}{'PoCL':>8}{'compiler':>10}{'all':>8}{'gone by':>9}  ms")
    for name, rows in (("first", times[:1]), ("others", times[1:])):
        own, compiler, gone = (statistics.mean(part) for part in zip(*rows))
        print(f"{name:8}{own:8.1f}{compiler:10.1f}{own + compiler:8.1f}{gone:9.1f}")


if __name__ == "__main__":
    command_line.run(main)
