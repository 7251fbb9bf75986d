#!/usr/bin/env python3
"""The compiler's processes, which stay, seen from the program that they serve: whose children they are, what happens if
they are ended, and that they do not outlive the program. Prints a line for each.

usage: tool_servers.py         the program, which runs itself once more as the one that compiles
Needs POCL_CACHE_DIR, an empty folder, which also tells these processes from others.
"""

import os
import signal
import stat
import subprocess
import sys
import time


def servers():
    """Processes that serve calls and have our folder in their environment."""
    mark = b"POCL_CACHE_DIR=" + os.environb[b"POCL_CACHE_DIR"]
    found = []
    for entry in os.listdir("/proc"):
        try:
            with open(f"/proc/{entry}/cmdline", "rb") as line, open(f"/proc/{entry}/environ", "rb") as environment:
                if b"--serve-calls" in line.read().split(b"\0") and mark in environment.read().split(b"\0"):
                    found.append(int(entry))
        except (OSError, ValueError):
            pass
    return found


def wait_for(count):
    for _ in range(300):
        if len(servers()) == count:
            break
        time.sleep(0.1)
    return len(servers())


def is_socket(descriptor):
    try:
        return stat.S_ISSOCK(os.fstat(descriptor).st_mode)
    except OSError:
        return False


def compiling():
    import numpy
    import pyopencl

    context = pyopencl.create_some_context(interactive=False)
    queue = pyopencl.CommandQueue(context)

    def runs(number):
        source = f"kernel void f(global int *o) {{ o[get_global_id(0)] = {number}; }}"
        out = numpy.zeros(4, numpy.int32)
        buffer = pyopencl.Buffer(context, pyopencl.mem_flags.WRITE_ONLY, out.nbytes)
        pyopencl.Program(context, source).build().f(queue, out.shape, None, buffer)
        pyopencl.enqueue_copy(queue, out, buffer)
        return bool((out == number).all())

    right = runs(1) and runs(2)
    first = set(servers())
    print("two kernels:", right, "by processes:", len(first))
    print("the same ones serve the next:", runs(3) and set(servers()) == first)
    try:
        os.waitpid(-1, os.WNOHANG)
        print("they are children")
    except ChildProcessError:
        print("they are nobody's children")
    # Descriptors are closed as programs do that do not know them, and a file of ours takes one's place.
    sockets = [number for number in map(int, os.listdir("/proc/self/fd")) if is_socket(number)]
    for socket in sockets:
        os.close(socket)
    ours = [os.open(os.environ["POCL_CACHE_DIR"] + "/ours", os.O_CREAT | os.O_RDWR) for _ in sockets]
    print("after a program closed", len(sockets), "sockets:", runs(5), "its files are open:",
          all(os.fstat(file).st_size == 0 for file in ours))
    first = set(servers())
    for server in first:
        os.kill(server, signal.SIGKILL)
    print("after they were ended:", runs(4), "by others:", len(servers()), not first & set(servers()))


def main():
    if sys.argv[1:] == ["compiling"]:
        compiling()
        return
    subprocess.run([sys.executable, __file__, "compiling"], check=True)
    print("after the program:", wait_for(0))


if __name__ == "__main__":
    main()
