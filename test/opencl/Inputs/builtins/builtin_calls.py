#!/usr/bin/env python3
"""Kernels that call every built-in function which clang declares for a version of OpenCL C.

usage: builtin_calls.py HEADER.i PATTERN OUT.cl [OTHER.i]

HEADER.i is clang's opencl-c.h after the preprocessor. PATTERN is a regular expression: every overload of the functions
whose names it matches is called, by kernels that share them out. Prints how many there are. An overload
that OTHER.i declares in the same words is left out: it has the same symbol, which another file calls.
"""

import re
import sys

from declarations import POINTER, declarations

IMAGE = re.compile(r"^(read_only|write_only|read_write) (image\w+)$")
# A kernel is compiled by a process of its own, so few kernels are fast; a very large one is slow.
CALLS_OF_KERNEL = 100
# The space of a pointer, and memory of that space that a kernel has.
SPACES = {"global": "(global {0} *)memory", "local": "(local {0} *)shared", "constant": "(constant {0} *)table"}


def argument(number, parameter):
    """(what is written before the call, the argument)"""
    pointer = POINTER.match(parameter.strip())
    if pointer:
        space, element = pointer.groups()
        for name, text in SPACES.items():
            if name in space:
                return "", text.format(element)
        if element == "void" or element.startswith("atomic"):
            return "", f"({element} *)shared"
        # half is no type of a variable without the extension.
        stored = "ushort" if element == "half" else element
        copy = f"{stored} v{number}[16]; for (int i = 0; i < 16; ++i) v{number}[i] = *(global {stored} *)memory; "
        return copy, f"({element} *)v{number}"
    if IMAGE.match(parameter.strip()):
        return "", "_".join(parameter.split())
    kind = next(word for word in parameter.split() if word != "const")
    if kind == "sampler_t":
        return "", "sampler"
    if kind == "event_t":
        return "", "0"
    return "", f"*(global {kind} *)(memory + {128 * number})"


def call(name, result, parameters):
    before, arguments = zip(*(argument(i, p) for i, p in enumerate(parameters))) if parameters else ((), ())
    text = f"{name}({', '.join(arguments)})"
    if result == "event_t":
        text = f"event_t event = {text}; wait_group_events(1, &event)"
    elif result != "void":
        text = f"*(global {result} *)(memory + 1024) = {text}"
    # What a function writes through a pointer is used.
    after = "".join(f" memory[2000] ^= ((char *)v{i})[3];" for i, b in enumerate(before) if b)
    return f"  {{ {''.join(before)}{text};{after} }}\n"


def images(overloads):
    """The parameters that a kernel needs for the images and the sampler of its calls."""
    types = {p.strip() for _, _, parameters in overloads for p in parameters}
    samplers = ", sampler_t sampler" if "sampler_t" in types else ""
    return samplers + "".join(f", {t} {'_'.join(t.split())}" for t in sorted(types) if IMAGE.match(t))


def main():
    header, pattern, path, *others = sys.argv[1:]
    elsewhere = [declarations(other) for other in others]
    chosen = {name: all_of for name, all_of in declarations(header).items() if re.search(pattern, name)}
    calls = [(name, *overload) for name, overloads in chosen.items() for overload in overloads
             if not any(overload in other[name] for other in elsewhere)]
    with open(path, "w", encoding="utf-8") as out:
        out.write("#pragma OPENCL EXTENSION cl_khr_fp16 : enable\n")
        for first in range(0, len(calls), CALLS_OF_KERNEL):
            share = calls[first:first + CALLS_OF_KERNEL]
            out.write(f"kernel void calls{first}(global char *memory, local char *shared, constant char *table"
                      f"{images(share)}) {{\n")
            out.writelines(call(*each) for each in share)
            out.write("}\n")
    print(f"{len(chosen)} functions, {sum(map(len, chosen.values()))} overloads, {len(calls)} called")


if __name__ == "__main__":
    main()
