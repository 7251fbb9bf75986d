"""Runs units on the host: the library's sources, compiled for it with clang's undefined-behaviour sanitizer."""

import os
import re
import shlex
import subprocess
import tempfile

import numpy as np

from .device import FILL, Runner
from .units import SHARED

FOR_DEVICE = "-target riscv32-unknown-elf -march=rv32imaf -mabi=ilp32f -ffreestanding"
FOR_HOST = "-target x86_64-linux-gnu -O1 -g1 -w"
# What C leaves undefined, without what libdevice/opencl/FreezePoison.cpp defines; and that.
SANITIZERS = "-fsanitize=undefined -fno-sanitize=shift,signed-integer-overflow,float-cast-overflow,builtin"
ALL_SANITIZERS = "-fsanitize=undefined"
# Where a work-item is, for PoCL's get_global_id() and get_local_id(); and the calls of the kernel, as kernels are launched.
MAIN = """
#include <stdio.h>
#include <stdlib.h>
#include <sys/mman.h>
#define OF_EACH_DIMENSION(NAME, VALUE) unsigned long NAME##x = VALUE, NAME##y = VALUE, NAME##z = VALUE
OF_EACH_DIMENSION(_global_offset_, 0);
OF_EACH_DIMENSION(_local_size_, 1);
OF_EACH_DIMENSION(_group_id_, 0);
OF_EACH_DIMENSION(_local_id_, 0);
void values(const char *in, const char *constants, char *out, char *shared);
static void *memory(size_t size) { return aligned_alloc(128, (size + 127) / 128 * 128); }
int main(int argc, char **argv) {
  const size_t in_size = strtoul(argv[1], 0, 10), out_size = strtoul(argv[2], 0, 10);
  const unsigned long items = strtoul(argv[3], 0, 10), group = strtoul(argv[4], 0, 10);
  char *in = memory(in_size), *out = memory(out_size), *shared = memory(SHARED * group);
  if (argc != 5 || fread(in, 1, in_size, stdin) + fread(out, 1, out_size, stdin) != in_size + out_size)
    return 2;
  _local_size_x = group;
  for (unsigned long i = 0; i < items; ++i) {
    _group_id_x = i / group;
    _local_id_x = i % group;
    values(in, in, out, shared);
  }
  return fwrite(out, 1, out_size, stdout) != out_size;
}
"""


def commands(build, sanitizers):
    """clang's calls for the library: (the file, the call for the host without input and output)."""
    text = subprocess.run(["ninja", "-C", f"{build}/pocl-build", "-t", "commands", "lib/kernel/vorion/kernel-vorion.bc"],
                          check=True, capture_output=True, text=True).stdout
    found = []
    for line in text.splitlines():
        match = re.search(r"&& (\S*clang\S* .*) -o \S+ -c (\S+)(.*)", line)
        if match:
            call = (match[1] + match[3]).replace(FOR_DEVICE, f"{FOR_HOST} {sanitizers}")
            call = call.replace("-DPOCL_DEVICE_ADDRESS_BITS=32", "-DPOCL_DEVICE_ADDRESS_BITS=64")
            # The plugin and the precompiled declarations are of the device.
            found.append((match[2], re.sub(r" -emit-llvm| (-fpass-plugin=|-include-pch )\S+", "", call)))
    return found


def library(build, folder, pattern, sanitizers):
    """Makes the library from the sources whose names match, what has changed since the last time.

    Gives what a Host needs: the library's file and the call that compiles OpenCL C.
    """
    os.makedirs(folder, exist_ok=True)
    calls = commands(build, sanitizers)
    chosen = [(path, call) for path, call in calls if re.search(pattern, os.path.basename(path))]
    objects = [f"{number}-{os.path.basename(path)}.o" for number, (path, _) in enumerate(chosen)]
    rules = "".join(f"build {name}: compile {path}\n  call = {call}\n" for name, (path, call) in zip(objects, chosen))
    with open(f"{folder}/build.ninja", "w", encoding="utf-8") as out:
        out.write("rule compile\n  command = $call -MD -MF $out.d -c $in -o $out\n  depfile = $out.d\n  deps = gcc\n"
                  "rule archive\n  command = rm -f $out && llvm-ar-19 rcs $out @$out.rsp\n  rspfile = $out.rsp\n"
                  f"  rspfile_content = $in\n{rules}build library.a: archive {' '.join(objects)}\n")
    subprocess.run(["ninja", "-C", folder, "--quiet", "library.a"], check=True)
    return f"{folder}/library.a", next(call for path, call in calls if path.endswith("/abs.cl"))


class Host(Runner):
    """What the sanitizer says is in reports."""

    errors = (subprocess.CalledProcessError,)

    def __init__(self, archive, call):
        self.archive, self.call = archive, shlex.split(call)
        self.reports = set()

    def outputs(self, program):
        """As Device's."""
        with tempfile.TemporaryDirectory() as folder:
            for name, text in (("kernel.cl", program.text), ("main.c", MAIN)):
                with open(f"{folder}/{name}", "w", encoding="utf-8") as file:
                    file.write(text)
            # The library has functions of vectors that no header declares, and these call some that nothing defines.
            made = f"{folder}/kernel"
            for call in ([*self.call, "-c", f"{made}.cl", "-o", f"{made}.o"],
                         [self.call[0], ALL_SANITIZERS, f"-DSHARED={SHARED}", f"{folder}/main.c", f"{made}.o",
                          self.archive, "-lm", "-static", "-Wl,--unresolved-symbols=ignore-all", "-o", made]):
                subprocess.run(call, check=True, capture_output=True)
            unit = program.units[0]
            found = np.full(program.output_size, FILL, np.uint8)
            ran = subprocess.run([made, *map(str, (program.input.size, found.size, unit.items, unit.group))],
                                 input=program.input.tobytes() + found.tobytes(), capture_output=True, check=True)
        self.reports.update(re.findall(r"\S+: runtime error: .*", ran.stderr.decode()))
        return program.results(np.frombuffer(ran.stdout, np.uint8), {})
