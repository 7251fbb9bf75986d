#!/usr/bin/env python3
"""A kernel of many small functions, each of which calls two others, so that millions of ways lead to the last ones.

usage: call_graph.py KERNELS.cl IN WANT   (writes the kernel, its numbers, and what it makes of them)
"""

import array
import sys

FUNCTIONS = 60


def value(number, x, known):
    if number < 2:
        return x + 1 if number == 0 else x * 3 & 0xffff
    key = (number, x)
    if key not in known:
        known[key] = value(number - 1, x >> 1, known) if x & 1 else value(number - 2, x + 1, known)
    return known[key]


def main():
    lines = ["#define N __attribute__((noinline))", "N int f0(int x) { return x + 1; }", "N int f1(int x) { return x * 3 & 0xffff; }"]
    lines += [f"N int f{n}(int x) {{ return x & 1 ? f{n - 1}(x >> 1) : f{n - 2}(x + 1); }}" for n in range(2, FUNCTIONS)]
    lines.append(f"kernel void k(global int *a) {{ int i = get_global_id(0); a[i] = f{FUNCTIONS - 1}(a[i]); }}")
    numbers = [i * 2654435761 % 65521 for i in range(64)]
    with open(sys.argv[1], "w", encoding="utf-8") as file:
        file.write("\n".join(lines) + "\n")
    for path, values in (sys.argv[2], numbers), (sys.argv[3], [value(FUNCTIONS - 1, x, {}) for x in numbers]):
        with open(path, "wb") as file:
            file.write(array.array("i", values).tobytes())


if __name__ == "__main__":
    main()
