#!/usr/bin/env python3
"""Runs C programs of others on the device: every file below FOLDER that has a main and ends with exit code 0 if all is right, as
compilers' own tests do.

The same program of the packaged clang, under qemu-riscv32, says which of them can be judged: those that it compiles and that end
with 0 there. On the device sixteen lanes run a program side by side and share its global variables. One that does not bear
that is run by one lane, with a larger stack.

exit codes: 0 none is wrong, 1 a program is wrong (its files are kept), 2 usage
"""

import argparse
import collections
import concurrent.futures
import glob
import os
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(os.path.dirname(HERE), "kernels"))

from machines import LEVELS, ROOT, Endless, Linux, failure, run  # noqa: E402

# Most compilers' tests are written in old C, and overflow and alias as they like.
FLAGS = ["-w", "-std=gnu89", "-fwrapv", "-fno-strict-aliasing", "-ffp-contract=off", "-fno-math-errno", "-Wno-implicit-int",
         "-Wno-int-conversion", "-Wno-implicit-function-declaration", "-Wno-incompatible-function-pointer-types",
         "-Wno-return-mismatch", "-isystem", os.path.join(HERE, "include")]
ONE_CORE = "clusters=1,sockets_per_cluster=1,cores_per_socket=1"
LINUX_SECONDS = 10  # of processor time
MACHINES = [("right", ONE_CORE, 20_000_000), ("right with one lane", ONE_CORE + ",lanes_per_warp=1,stack_bytes=4194304", 600_000_000)]


def under_linux(libraries, source, base, level):
    """Whether the program can be judged."""
    program = base + ".linux"
    built = run(["clang-19", *Linux.FLAGS, *FLAGS, level, "-nostdlib", "-static", "-fuse-ld=lld", source, *libraries, "-o", program])
    if built.returncode:
        return False
    try:
        return Linux.execute(program, LINUX_SECONDS).returncode == 0
    except Endless:
        return False
    finally:
        os.remove(program)


def on_device(library, source, base, level):
    """A word that main() counts, and what is said of the program."""
    program = base + ".elf"
    built = run(["vorion-clang", *FLAGS, level, source, library, "-o", program])
    if built.returncode:
        return "refused", failure(built)
    for word, machine, most in MACHINES:
        ran = run(["vorion-sim", "--set", "host_threads=1", "--set", f"max_instructions={most}", "--set", machine, program], stdout=subprocess.DEVNULL)
        if ran.returncode == 0:
            os.remove(program)
            return word, ""
    return "wrong", f"{failure(ran)}; {program}"


def judge(linux_libraries, library, folder, source, level):
    base = os.path.join(folder, os.path.splitext(os.path.basename(source))[0] + level)
    if not under_linux(linux_libraries, source, base, level):
        return source, level, "not judged", ""
    return source, level, *on_device(library, source, base, level)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("programs", metavar="FOLDER")
    parser.add_argument("--levels", default="-O2", help=f"options of the compilers, as {','.join(LEVELS)} (default: -O2)")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--folder", default=os.path.join(ROOT, "build", "c-programs"), help="for files (build/c-programs)")
    chosen = parser.parse_args()
    sources = sorted(glob.glob(os.path.join(chosen.programs, "**", "*.c"), recursive=True))
    if not sources:
        parser.error(f"no .c file below {chosen.programs}, expected programs in C")
    os.makedirs(chosen.folder, exist_ok=True)
    linux_library, library = os.path.join(chosen.folder, "linux.o"), os.path.join(chosen.folder, "device.o")
    for command, output in ((["clang-19", *Linux.FLAGS], linux_library), (["vorion-clang"], library)):
        subprocess.run([*command, *FLAGS, "-std=gnu11", "-fno-builtin", "-O1", "-c", os.path.join(HERE, "library.c"), "-o", output],
                       check=True)
    linux_libraries = [linux_library, *Linux(chosen.folder).library]
    counts = collections.Counter()
    with concurrent.futures.ProcessPoolExecutor(chosen.jobs) as pool:
        running = [pool.submit(judge, linux_libraries, library, chosen.folder, source, level)
                   for level in chosen.levels.split(",") for source in sources]
        for one in running:
            source, level, word, said = one.result()
            counts[word] += 1
            if said:
                print(f"{word}: {os.path.relpath(source, chosen.programs)} {level}: {said}", flush=True)
    print(f"{sum(counts.values())} runs: " + ", ".join(f"{counts[word]} {word}" for word in
                                                    ("right", "right with one lane", "refused", "wrong", "not judged")))
    return 1 if counts["wrong"] else 0


if __name__ == "__main__":
    sys.exit(main())
