#!/usr/bin/env python3
"""Prints clang's options for what the device offers: usage: feature_flags.py libdevice/opencl/Features.cmake

They are written as a response file: -cl-ext for the front end, and a macro for each name.
"""

import re
import sys


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        names = re.findall(r"\b(?:cl_khr|__opencl_c)_\w+", file.read())
    print("-Xclang -cl-ext=-all," + ",".join("+" + name for name in names))
    for name in names:
        print(f"-D{name}=1")


if __name__ == "__main__":
    main()
