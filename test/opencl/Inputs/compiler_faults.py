#!/usr/bin/env python3
"""Builds programs while their compiler is killed, or its memory limited, at random moments.
Each build either gives the right result, or an error with a reason in its log, and the process goes on.

usage: compiler_faults.py [--count N] [--seed N] FOLDER

FOLDER becomes the kernel cache. Prints one line, and one more for each build that is wrong.
"""

import argparse
import collections
import contextlib
import os
import random
import resource
import shutil
import signal
import sys
import threading

import numpy
import pyopencl as cl

SOURCE = """
kernel void f(global uint *out, uint n) {{
  local uint shared[64];
  uint at = get_local_id(0), sum = {number};
  for (uint i = 0; i < n; ++i) {{
    shared[at] = sum * 3 + i;
    barrier(CLK_LOCAL_MEM_FENCE);
    sum += shared[(at + i) % 64];
    barrier(CLK_LOCAL_MEM_FENCE);
  }}
  out[get_global_id(0)] = sum;
}}
"""
SIGNALS = [signal.SIGKILL, signal.SIGSEGV, signal.SIGABRT, signal.SIGBUS, signal.SIGTERM]


def expected(number, turns):
    sums = numpy.full(64, number, numpy.uint32)
    for i in range(turns):
        shared = sums * numpy.uint32(3) + numpy.uint32(i)
        sums = sums + numpy.roll(shared, -i)
    return sums


def compilers(mark):
    found = []
    for entry in filter(str.isdigit, os.listdir("/proc")):
        try:
            with open(f"/proc/{entry}/environ", "rb") as environment, open(f"/proc/{entry}/cmdline", "rb") as line:
                if mark in environment.read().split(b"\0") and b"--serve-calls" in line.read():
                    found.append(int(entry))
        except OSError: # it has ended
            pass
    return found


def disturb(chance, mark, way, over, done):
    """Kills or limits compilers until `over`, at random moments: also the process that waits for another."""
    while not over.wait(chance.random() * 0.08):
        for process in compilers(mark):
            if chance.random() < 0.4:
                continue
            try:
                if way == "killed":
                    os.kill(process, chance.choice(SIGNALS))
                else:
                    resource.prlimit(process, resource.RLIMIT_AS, (chance.randrange(1, 400) << 20,) * 2)
                done[way] += 1
            except (ProcessLookupError, PermissionError):
                pass


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("folder")
    options = parser.parse_args()
    shutil.rmtree(options.folder, ignore_errors=True)
    os.makedirs(options.folder)
    os.environ.update(POCL_CACHE_DIR=options.folder, PYOPENCL_NO_CACHE="1", COMPILER_FAULTS=str(os.getpid()))
    mark = f"COMPILER_FAULTS={os.getpid()}".encode()
    chance = random.Random(options.seed)
    done = collections.Counter()
    context = cl.create_some_context(interactive=False)
    queue = cl.CommandQueue(context)
    buffer = cl.Buffer(context, cl.mem_flags.READ_WRITE, 256)

    def build(number):
        """What is wrong; empty if nothing."""
        out = numpy.zeros(64, numpy.uint32)
        cl.enqueue_copy(queue, buffer, out)
        try:
            program = cl.Program(context, SOURCE.format(number=number)).build()
            program.f(queue, (64,), (64,), buffer, numpy.uint32(5)).wait()
        except cl.Error as error:
            done["failed"] += 1
            return "" if str(error).strip() else "an error without a reason"
        cl.enqueue_copy(queue, out, buffer)
        done["right"] += 1
        return "" if (out == expected(number, 5)).all() else f"{out}"

    wrong = 0
    for number in range(options.count):
        way = chance.choice(["killed", "killed", "limited", ""])
        over = threading.Event()
        other = threading.Thread(target=disturb, args=(chance, mark, way, over, done))
        if way:
            other.start()
        problem = build(number)
        over.set()
        if way:
            other.join()
        # Then all is well, if not for a compiler that is still limited.
        for process in compilers(mark) if way == "limited" else ():
            with contextlib.suppress(ProcessLookupError): # it has ended
                os.kill(process, signal.SIGKILL)
        failed = done["failed"]
        problem = problem or build(number) or ("fails afterwards" if done["failed"] > failed else "")
        if problem:
            wrong += 1
            print(f"build {number}, {way}: {problem}")
    told = ", ".join(f"{done[what]} {what}" for what in ("right", "failed", "killed", "limited"))
    print(f"{options.count} builds, each twice: {told}, {wrong} wrong")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
