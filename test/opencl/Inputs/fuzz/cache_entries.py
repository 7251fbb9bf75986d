#!/usr/bin/env python3
"""Damages the kernel cache and runs a program that uses it: the program must
work as with a good cache, say once what is damaged, and leave a good cache
behind. Each seed is one case; finds stay in FOLDER/seed-N."""

import os
import random
import shutil
import sys

import cases


def files_of(folder):
    found = [os.path.join(at, name) for at, _, names in os.walk(folder) for name in names]
    return sorted(found)


def damage(path, others, chance):
    """Changes one file and says how; "" if it is as it was."""
    with open(path, "rb") as file:
        before = file.read()
    data = bytearray(before)
    kind = chance.choice(["bits", "bytes", "cut", "longer", "empty", "zeros", "other", "gone",
                          "folder", "block"])
    if kind == "gone" or kind == "folder":
        os.remove(path)
        if kind == "folder":
            os.mkdir(path)
        return kind
    if kind == "bits" and data:
        for _ in range(chance.randint(1, 3)):
            data[chance.randrange(len(data))] ^= 1 << chance.randrange(8)
    elif kind == "bytes" and data:
        for _ in range(chance.randint(1, 40)):
            data[chance.randrange(len(data))] = chance.randrange(256)
    elif kind == "cut":
        del data[chance.randrange(len(data) + 1):]
    elif kind == "longer":
        data += chance.randbytes(chance.choice([1, 7, 8, 4096]))
    elif kind == "empty":
        data = bytearray()
    elif kind == "zeros":
        data = bytearray(len(data))
    elif kind == "other":
        with open(chance.choice(others), "rb") as file:
            data = bytearray(file.read())
    elif kind == "block" and data:
        at = chance.randrange(len(data))
        length = min(512, len(data) - at)
        data[at:at + length] = bytes(length)
    with open(path, "wb") as file:
        file.write(data)
    return kind if data != before else ""


def main():
    parser = cases.options(__doc__)
    parser.add_argument("--program", action="append",
                        help="what is run (default: sample-vecadd and sample-scan)")
    arguments = parser.parse_args()
    programs = arguments.program or ["sample-vecadd", "sample-scan"]
    os.makedirs(arguments.folder, exist_ok=True)
    good = os.path.join(arguments.folder, "good")

    def use(cache):
        outputs = []
        for program in programs:
            code, output = cases.run([program], env={**os.environ, "POCL_CACHE_DIR": cache})
            if code != 0:
                return f"{program} ended with {code}: {output}", ""
            outputs.append(output)
        return "", "".join(outputs)

    shutil.rmtree(good, ignore_errors=True)
    wrong, expected = use(good)
    if wrong:
        print(wrong)
        return 1
    names = [os.path.relpath(path, good) for path in files_of(good)]
    # A folder of each program, and what of the text names it.
    programs_of_texts = {}
    for name in names:
        if os.path.basename(name) == "known":
            with open(os.path.join(good, name), "rb") as known:
                programs_of_texts[name] = known.read().split(b"\0")[0].decode()

    def case(seed):
        chance = random.Random(seed)
        cache = os.path.join(arguments.folder, f"seed-{seed}")
        shutil.rmtree(cache, ignore_errors=True)
        shutil.copytree(good, cache)
        done = []
        for name in chance.sample(names, chance.choice([1, 1, 1, 2, len(names)])):
            how = damage(os.path.join(cache, name), [os.path.join(good, n) for n in names], chance)
            if how:
                done.append((name, how))
        wrong, output = use(cache)
        warnings = [line for line in output.splitlines() if "is damaged, it is made again" in line]
        rest = [line for line in output.splitlines() if line not in warnings]
        if not wrong and rest != expected.splitlines():
            wrong = f"printed {output}"
        if not wrong and len(set(warnings)) != len(warnings):
            wrong = f"said it twice: {output}"
        # What the program reads must have been noticed. If the cache does not know a text
        # any more, or lacks its program, clang works on it. That reads the headers, and
        # the answer describes the kernels, so their description is not read.
        done_names = {name for name, _ in done}
        compiled = [program for text, program in programs_of_texts.items()
                    if done_names & {text, f"{program}/program.bc"}]

        def is_read(name):
            if name.endswith(".pch"):
                return bool(compiled)
            if name.endswith("/kernels"):
                return os.path.dirname(name) not in compiled
            # An image that belongs to a damaged program is read all the same.
            return name.endswith((".elf", "program.bc", "/known"))

        read = [name for name, how in done if how != "gone" and is_read(name)]
        if not wrong and len(warnings) != len(read):
            wrong = f"{len(warnings)} warnings for {len(read)} damaged entries: {output}"
        if not wrong:
            wrong, output = use(cache)
            if not wrong and output != expected:
                wrong = f"not made again: {output}"
        if not wrong:
            shutil.rmtree(cache)
            return ""
        return f"{done}: {wrong}"

    return cases.each(arguments, case)


if __name__ == "__main__":
    sys.exit(main())
