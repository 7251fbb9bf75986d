#!/usr/bin/env python3
"""The clock's cores beside Vortex's RTL on whole kernels, as Markdown tables.

usage: kernels.py [--write FOLDER] [--peer PROGRAM] [KERNEL...]

The kernels are those of kernels/, with the cycles that each took on the RTL in kernels/references.json. Both ran the
same image of memory, from the first instruction to the end, with caches that are empty at first and memory that
answers every request after the same time. A reference holds for one image, so kernels/compiled/ keeps the assembly that
ran on the RTL. An image that differs is an error. So is a result that is not the RTL's. A new kernel's assembly is made by
`vorion-clang -march=rv32imf_zicsr_xvortex -O2 -fno-math-errno -S`. FOLDER gets each kernel as KERNEL.elf.
PROGRAM is called with that folder and prints what references.json has; its machines take the place of those of the same name.

exit codes: 0 all kernels within 15 % and, where all of a machine's are chosen, their geometric mean within 5 %, 1 not so,
2 usage
"""

import argparse
import hashlib
import json
import math
import os
import struct
import subprocess
import sys
import tempfile

sys.path.append(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))

import clocked
import command_line
import cores
import peers

HERE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "kernels")
OF_ONE, OF_ALL = 0.15, 0.05
# What both machines have: the extensions that Vortex knows, too.
MARCH = "-march=rv32imf_zicsr_xvortex"


def compiler_folder():
    return os.path.dirname(os.path.dirname(subprocess.run(
        ["which", "vorion-clang"], check=True, capture_output=True, text=True).stdout.strip()))


def assembled(folder, source):
    """The object of an assembly file, in \\p folder."""
    path = os.path.join(folder, os.path.basename(source) + ".o")
    subprocess.run(["vorion-clang", MARCH, "-c", source, "-o", path], check=True)
    return path


def linked(objects, program):
    """Links \\p objects to \\p program."""
    script = os.path.join(compiler_folder(), "lib", "vorion", "vorion.ld")
    subprocess.run(["ld.lld-19", "-T", script, *objects, "-o", program], check=True)
    return program


def build(folder, kernels):
    """{kernel: its program}, in \\p folder."""
    start, inputs = (assembled(folder, os.path.join(HERE, source)) for source in ("start.s", "inputs.s"))
    return {kernel: linked([start, assembled(folder, os.path.join(HERE, "compiled", kernel + ".s")), inputs],
                           os.path.join(folder, kernel + ".elf")) for kernel in kernels}


def hash_of(data):
    return hashlib.sha256(data).hexdigest()[:16]


def image_of(program):
    """What an ELF file puts into memory, from its first address on."""
    with open(program, "rb") as file:
        elf = file.read()
    at, size, count = struct.unpack_from("<I", elf, 28)[0], *struct.unpack_from("<HH", elf, 42)
    segments = [struct.unpack_from("<8I", elf, at + n * size) for n in range(count)]
    loaded = sorted((address, elf[offset:offset + length])
                    for kind, offset, address, _, length, _, _, _ in segments if kind == 1 and length)
    image = b""
    for address, data in loaded:
        image = image.ljust(address - loaded[0][0], b"\0") + data
    return image


def ours(program, machine, more=()):
    """(time report, hash of the result) of a program on our machine, and what else is changed."""
    changes = ("timing.socket.icache_kib=16", "timing.core.interleaved_stacks=0",
               f"timing.l2.fixed_cycles={machine['fixed_cycles']}", *more)
    result = program + ".result"
    time = cores.time_of(program, machine["preset"], machine["warps"], changes, ("--signature", result))
    with open(result) as file:
        return time, hash_of(b"".join(struct.pack("<I", int(line, 16)) for line in file))


def another_image(program, reference):
    """What is wrong if the RTL ran another image."""
    image = hash_of(image_of(program))
    return f"image {image}, expected {reference['image']}, which the RTL ran" if image != reference["image"] else ""


def table(machine, programs):
    """Prints a machine's rows; returns what is wrong."""
    name, wrong, ratios, names = machine["name"], [], [], []
    if not programs.keys() & machine["kernels"].keys():
        return []
    print(f"\n`{machine['preset']}` beside `{name}`, {machine['warps']} warp{'s' if machine['warps'] > 1 else ''}, "
          "cycles of a whole kernel:\n")
    print("| kernel | ours | RTL | error |\n|---|--:|--:|--:|")
    for kernel, reference in machine["kernels"].items():
        if kernel not in programs:
            continue
        if another := another_image(programs[kernel], reference):
            wrong.append(f"{name}: {kernel}: {another}")
            continue
        time, result = ours(programs[kernel], machine)
        cycles = time["cycles"]
        names.append(clocked.name(time))
        if result != reference["result"]:
            wrong.append(f"{name}: {kernel}: result {result}, expected {reference['result']}")
        ratio = cycles / reference["cycles"]
        ratios.append(ratio)
        print(f"| `{kernel}` | {cycles} | {reference['cycles']} | {100 * (ratio - 1):+.1f} % |")
        if abs(ratio - 1) > OF_ONE:
            wrong.append(f"{name}: {kernel}: {cycles} cycles, expected {reference['cycles']} within {100 * OF_ONE:.0f} %")
    # Of some kernels it says nothing of the machine.
    if len(ratios) == len(machine["kernels"]):
        mean = math.exp(sum(map(math.log, ratios)) / len(ratios))
        print(f"| geometric mean | | | {100 * (mean - 1):+.1f} % |")
        if abs(mean - 1) > OF_ALL:
            wrong.append(f"{name}: geometric mean {mean:.3f}, expected 1 within {100 * OF_ALL:.0f} %")
    if names:
        clocked.say(names)
    return wrong


def arguments(description, there):
    """The command line of a script that compares some of the kernels that are there."""
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--write", metavar="FOLDER")
    peers.add(parser)
    parser.add_argument("kernels", nargs="*", metavar="KERNEL")
    args = parser.parse_args()
    unknown = [kernel for kernel in args.kernels if kernel not in there]
    if unknown:
        parser.error(f"{unknown[0]}: no such kernel, expected some of {', '.join(there)}")
    return args


def main():
    there = sorted(name.removesuffix(".s") for name in os.listdir(os.path.join(HERE, "compiled")))
    args = arguments(__doc__, there)
    with open(os.path.join(HERE, "references.json")) as file:
        machines = {machine["name"]: machine for machine in json.load(file)}
    wrong = []
    with tempfile.TemporaryDirectory() as temporary:
        folder = args.write or temporary
        os.makedirs(folder, exist_ok=True)
        programs = build(folder, args.kernels or there)
        if args.peer:
            machines |= {machine["name"]: machine for machine in peers.figures(args.peer, list, folder)}
        for machine in machines.values():
            wrong += table(machine, programs)
    for line in wrong:
        print(f"kernels.py: error: {line}", file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    command_line.run(main)
