#!/usr/bin/env python3
"""Runs an OpenCL program whose kernel cache is a file system of a few hundred kilobytes, which becomes full at another
place for each size. The program either gives the right result, or ends with a reason: no signal, no wrong kernel.

usage: small_disks.py [--from KB] [--to KB] [--step KB] FOLDER PROGRAM [ARGUMENT...]

Mounts each file system on FOLDER, in which the program's cache and temporary files are. Needs a mount namespace of its
own (unshare -rm). Prints one line, and one more for each size that is wrong.
"""

import argparse
import collections
import os
import re
import shutil
import subprocess
import sys

REASON = re.compile(r"kernel cache: |No space left on device|memory|[Oo]ut of")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--from", type=int, default=100, dest="first")
    parser.add_argument("--to", type=int, default=900, dest="last")
    parser.add_argument("--step", type=int, default=20)
    parser.add_argument("folder")
    parser.add_argument("program", nargs=argparse.REMAINDER)
    options = parser.parse_args()
    if not options.program or not shutil.which(options.program[0]):
        parser.error(f"{' '.join(options.program[:1])}: no such program, expected one that uses OpenCL")
    options.program[0] = os.path.abspath(shutil.which(options.program[0])) # it runs in another folder
    os.makedirs(options.folder, exist_ok=True)
    environment = {**os.environ, "POCL_CACHE_DIR": os.path.join(options.folder, "cache"), "TMPDIR": options.folder}
    good = subprocess.run(options.program, capture_output=True, text=True, check=True,
                          env={**environment, "POCL_KERNEL_CACHE": "0"}).stdout
    done = collections.Counter()
    sizes = range(options.first, options.last + 1, options.step)
    for size in sizes:
        subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={size}k", "none", options.folder], check=True)
        try:
            run = subprocess.run(options.program, capture_output=True, text=True, check=False, env=environment,
                                 cwd=options.folder)
        finally:
            subprocess.run(["umount", "-l", options.folder], check=True)
        if run.returncode == 0 and run.stdout == good:
            done["right"] += 1
        elif run.returncode > 0 and REASON.search(run.stdout + run.stderr):
            done["failed with a reason"] += 1
        else:
            done["wrong"] += 1
            print(f"{size} KB: exit code {run.returncode}: {run.stdout}{run.stderr}")
    print(f"{len(sizes)} sizes: " + ", ".join(f"{done[what]} {what}" for what in ("right", "failed with a reason", "wrong")))
    return 1 if done["wrong"] else 0


if __name__ == "__main__":
    sys.exit(main())
