#!/usr/bin/env python3
"""Every way in which an executable may be malformed.

usage: malformed_elf.py SIMULATOR GOOD FOLDER

Writes variants of the program GOOD, which has a kernel, to FOLDER and runs each: the simulator must say in one line what is
wrong with the file, and end with exit code 3. Prints how many there were.
exit codes: 0 all did, 1 some did not
"""

import os
import struct
import subprocess
import sys

EHDR = ("ident:16s type:H machine:H version:I entry:I phoff:I shoff:I flags:I ehsize:H phentsize:H phnum:H shentsize:H "
        "shnum:H shstrndx:H")
PHDR = "type:I offset:I vaddr:I paddr:I filesz:I memsz:I flags:I align:I"
SHDR = "name:I type:I flags:I addr:I offset:I size:I link:I info:I addralign:I entsize:I"
KERNEL = "name:I entry:I args:I nargs:I args_bytes:I context:I local:I x:I y:I z:I lanes:I"
ARG = "name:I kind:I offset:I size:I"
LOAD, SYMTAB, EXECUTE, WRITE = 1, 2, 1, 2
HUGE = 0xFFFFFFF0


class Layout:
    """Where the fields of a structure are."""

    def __init__(self, text):
        self.at, self.size = {}, 0
        for field in text.split():
            name, code = field.split(":")
            self.at[name] = (self.size, "<" + code)
            self.size += struct.calcsize("<" + code)


class Elf:
    def __init__(self, data):
        self.data = data
        self.header, self.segment, self.section = Layout(EHDR), Layout(PHDR), Layout(SHDR)
        self.phoff, self.phnum = self.get(self.header, 0, "phoff"), self.get(self.header, 0, "phnum")
        self.shoff, self.shnum = self.get(self.header, 0, "shoff"), self.get(self.header, 0, "shnum")

    def get(self, layout, base, field):
        place, code = layout.at[field]
        return struct.unpack_from(code, self.data, base + place)[0]

    def set(self, layout, base, **fields):
        """A copy with other values in the fields of the structure at base."""
        changed = bytearray(self.data)
        for field, value in fields.items():
            place, code = layout.at[field]
            struct.pack_into(code, changed, base + place, value)
        return bytes(changed)

    def segments(self, flags=0):
        """Offsets of the headers of what is loaded."""
        for n in range(self.phnum):
            base = self.phoff + n * self.segment.size
            if self.get(self.segment, base, "type") == LOAD and self.get(self.segment, base, "flags") & flags == flags:
                yield base

    def sections(self):
        return [self.shoff + n * self.section.size for n in range(self.shnum)]

    def file_place(self, address):
        for base in self.segments():
            within = address - self.get(self.segment, base, "vaddr")
            if 0 <= within < self.get(self.segment, base, "filesz"):
                return self.get(self.segment, base, "offset") + within
        raise ValueError(f"{address:#x} is in no segment")


def truncations(elf):
    cuts = {0, 1, len(elf.data) - 1}
    structures = [(elf.header, 0)]
    structures += [(elf.segment, elf.phoff + n * elf.segment.size) for n in range(elf.phnum)]
    structures += [(elf.section, base) for base in elf.sections()]
    for layout, base in structures:
        cuts |= {base + place for place, _ in layout.at.values()} | {base + 1}
    for base in elf.segments():
        offset, size = elf.get(elf.segment, base, "offset"), elf.get(elf.segment, base, "filesz")
        cuts |= {offset, offset + size // 2, offset + size - 1}
    for cut in sorted(cuts):
        yield f"cut-{cut}", elf.data[:cut]


def headers(elf):
    ident = elf.get(elf.header, 0, "ident")
    for place, values in ((0, (0,)), (1, (0,)), (2, (0,)), (3, (0,)), (4, (0, 2, 3)), (5, (0, 2, 3)), (6, (0, 2))):
        for value in values:
            yield f"ident-{place}-{value}", elf.set(elf.header, 0, ident=ident[:place] + bytes([value]) + ident[place + 1:])
    bad = {"type": (0, 1, 3, 4, 0xFFFF), "machine": (0, 3, 62, 0xFFFF), "version": (0, 2, HUGE), "flags": (1, 4, 6, 8, 11),
           "entry": (0, 1, 0x80000001, 0x80FFFFFC, HUGE), "phoff": (len(elf.data), len(elf.data) - 1, HUGE),
           "phentsize": (0, 31, 33, 0xFFFF), "phnum": (0, 0xFFFF), "shoff": (len(elf.data), len(elf.data) - 1, HUGE),
           "shentsize": (0, 39, 41, 0xFFFF), "shnum": (0xFFFF,), "shstrndx": (elf.shnum, 0xFFFF)}
    for field, values in bad.items():
        for value in values:
            yield f"header-{field}-{value:x}", elf.set(elf.header, 0, **{field: value})


def segments(elf):
    every = list(elf.segments())
    code = next(elf.segments(EXECUTE))
    for n, base in enumerate(every):
        memory = elf.get(elf.segment, base, "memsz")
        bad = {"offset": (len(elf.data), HUGE), "filesz": (memory + 1, len(elf.data), HUGE), "memsz": (0x1000001, HUGE),
               "vaddr": (0, 0x10000, 0x7FFFFFFC, 0x81000000, 0xFFFF0000, HUGE)}
        for field, values in bad.items():
            for value in values:
                yield f"segment-{n}-{field}-{value:x}", elf.set(elf.segment, base, **{field: value})
        for other in every:
            if other != base:
                yield (f"segment-{n}-overlaps-{every.index(other)}",
                       elf.set(elf.segment, base, vaddr=elf.get(elf.segment, other, "vaddr")))
    address = elf.get(elf.segment, code, "vaddr")
    yield "code-writable", elf.set(elf.segment, code, flags=EXECUTE | WRITE | 4)
    yield "code-not-executable", elf.set(elf.segment, code, flags=4)
    yield "code-misaligned", elf.set(elf.segment, code, vaddr=address + 2)
    # As many headers as there can be, each of the whole file: more memory than there is.
    header = elf.data[code:code + elf.segment.size]
    many = bytearray(elf.data) + header * 0xFFFE
    struct.pack_into("<I", many, elf.header.at["phoff"][0], len(elf.data))
    struct.pack_into("<H", many, elf.header.at["phnum"][0], 0xFFFE)
    yield "segments-many", bytes(many)


def sections(elf):
    names = elf.sections()[elf.get(elf.header, 0, "shstrndx")]
    symbols = next(base for base in elf.sections() if elf.get(elf.section, base, "type") == SYMTAB)
    strings = elf.sections()[elf.get(elf.section, symbols, "link")]
    for title, base in (("names", names), ("symbols", symbols), ("strings", strings)):
        for field in ("offset", "size"):
            for value in (len(elf.data) + 1, HUGE):
                yield f"{title}-{field}-{value:x}", elf.set(elf.section, base, **{field: value})
    for value in (elf.shnum, HUGE):
        yield f"symbols-link-{value:x}", elf.set(elf.section, symbols, link=value)
    yield "symbols-twice", elf.set(elf.section, strings, type=SYMTAB)


def kernels(elf):
    table = next(base for base in elf.sections() if elf.get(elf.section, base, "name") and
                 elf.data[elf.get(elf.section, elf.sections()[elf.get(elf.header, 0, "shstrndx")], "offset")
                          + elf.get(elf.section, base, "name"):].startswith(b"vorion_kernels\0"))
    for field, values in {"addr": (0, 0x80FFFFF0, HUGE), "size": (1, 43, 88, HUGE)}.items():
        for value in values:
            yield f"table-{field}-{value:x}", elf.set(elf.section, table, **{field: value})
    kernel, arg = Layout(KERNEL), Layout(ARG)
    record = elf.file_place(elf.get(elf.section, table, "addr"))
    first = elf.file_place(elf.get(kernel, record, "args"))
    total = elf.get(kernel, record, "args_bytes")
    bad = {"name": (0, 0x80FFFFFF, HUGE), "entry": (0, 2, 0x80000002, 0x80FFFFFC, HUGE), "args": (0, 0x80FFFFFC, HUGE),
           "nargs": (4097, HUGE), "args_bytes": (0, total - 1, 0x40001, 0xFFFFFFFF)}
    for field, values in bad.items():
        for value in values:
            yield f"kernel-{field}-{value:x}", elf.set(kernel, record, **{field: value})
    for number, sizes in enumerate(((16, 0, 0), (0, 0, 1), (16, 16, 0), (0, 1, 1))):
        yield f"kernel-groups-{number}", elf.set(kernel, record, **dict(zip("xyz", sizes)))
    for field, values in {"name": (0, HUGE), "kind": (5, HUGE), "offset": (total, HUGE), "size": (total + 1, HUGE)}.items():
        for value in values:
            yield f"arg-{field}-{value:x}", elf.set(arg, first, **{field: value})


def others():
    yield "text", b"not a program\n" * 10
    yield "zeros", bytes(4096)
    yield "elf-magic-only", b"\x7fELF"


def main():
    simulator, good, folder = sys.argv[1:]
    os.makedirs(folder, exist_ok=True)
    with open(good, "rb") as file:
        elf = Elf(file.read())
    variants = [*truncations(elf), *headers(elf), *segments(elf), *sections(elf), *kernels(elf), *others()]
    wrong = 0
    for name, data in variants:
        path = os.path.join(folder, name + ".elf")
        with open(path, "wb") as file:
            file.write(data)
        ran = subprocess.run([simulator, path, "--list-kernels"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        line = ran.stderr.splitlines()
        if ran.returncode == 3 and not ran.stdout and len(line) == 1 and line[0].startswith(f"vorion-sim: error: {path}: "):
            os.remove(path)
            continue
        wrong += 1
        print(f"{path}: exit code {ran.returncode}: {ran.stderr or ran.stdout}")
    print(f"{len(variants)} malformed programs, {wrong} not refused in one line with exit code 3")
    return wrong != 0


if __name__ == "__main__":
    sys.exit(main())
