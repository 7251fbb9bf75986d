#!/usr/bin/env python3
"""Follows docs/adding-an-instruction.md in a copy of the repository: puts its texts where it says, then looks for the
new instruction in everything that is derived from the records.

usage: follow.py [--all] FOLDER
FOLDER is made anew. --all runs the page's last step too, which builds the compiler (minutes).
Exit codes: 0 all as the page says, 1 not, 2 usage.
"""

import argparse
import os
import re
import shutil
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
PAGE = "docs/adding-an-instruction.md"
COPIED = ("CMakeLists.txt", "CMakePresets.json", "cmake", "docs", "intrinsics", "isasim", "libdevice", "llvm-backend",
          "scripts", "support", "test")
# The page's instruction with rd = a0, rs1 = t2, rs2 = s3: format R of the unprivileged specification.
TEXT = "vx_absdiff\ta0, t2, s3"
WORD = 2 << 25 | 19 << 20 | 7 << 15 | 0 << 12 | 10 << 7 | 0x0B


def fail(text):
    print(f"follow.py: error: {text}", file=sys.stderr)
    sys.exit(1)


def run(folder, *command, **options):
    done = subprocess.run(command, cwd=folder, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, **options)
    if done.returncode:
        fail(f"{' '.join(command)} ended with {done.returncode}:\n{done.stdout[-4000:]}")
    return done.stdout


def steps(page):
    """("append", file, text) and ("run", commands) in the order of the page."""
    for match in re.finditer(r"(?:At the end of `([^`]+)`:\n\n)?^ *```([a-z+]+)\n(.*?)^ *```$", page, re.M | re.S):
        file, language, body = match.groups()
        body = re.sub("^   ", "", body, flags=re.M)
        if language == "sh":
            yield "run", body
        elif file:
            yield "append", file, body
        else:
            fail(f"{PAGE}: the text '{body.splitlines()[0]}' has no place")


def expect(text, pattern, where):
    if not re.search(pattern, text, re.M):
        fail(f"{where}: no line like '{pattern}'")
    print(f"found in {where}")


def read(folder, name):
    with open(os.path.join(folder, name), encoding="utf-8") as file:
        return file.read()


def check_generated(folder):
    """Everything that the generators write, and what LLVM's TableGen makes of it."""
    out = os.path.join(folder, "generated")
    os.makedirs(out)
    generators = os.path.join(folder, "intrinsics", "generate")
    for script, arguments in (("header.py", ["--for", "device", f"{out}/vorion.h"]), ("backend.py", [out]),
                              ("latencies.py", ["--scheduling", f"{out}/VorionLatencies.td"]),
                              ("isasim.py", [f"{out}/IsaTables.h"])):
        run(folder, sys.executable, os.path.join(generators, script), *arguments)
    expect(read(folder, "docs/isa.md"), r"^\| `vx_absdiff rd, rs1, rs2` \| `0400000b/fe00707f` \|", "docs/isa.md")
    expect(read(out, "vorion.h"), r"^uint vx_absdiff\(uint a, uint b\) VORION_INTRINSIC\(vx_absdiff\);", "vorion.h")
    expect(read(out, "IsaTables.h"), r'"vx_absdiff", "rd, rs1, rs2", 0x400000b, 0xfe00707f', "IsaTables.h")
    expect(read(out, "VorionIntrinsics.def"), r"^VORION_INTRINSIC\(vx_absdiff, VX_ABSDIFF, -1, 2, true, Operands,",
           "VorionIntrinsics.def")
    target = os.path.join(folder, "build", "sources", "llvm", "llvm", "lib", "Target", "RISCV")
    include = run(folder, "llvm-config-19", "--includedir").strip()
    new = os.path.join(folder, "llvm-backend", "new")
    emitter = run(folder, "llvm-tblgen-19", "-gen-emitter", "-I", new, "-I", target, "-I", include, "-I", out,
                  os.path.join(new, "Vorion.td"))
    expect(emitter, rf"UINT64_C\({2 << 25 | 0x0B}\),\s*// VX_ABSDIFF$", "LLVM's encodings")
    records = os.path.join(folder, "test", "Inputs", "records", "record_tests.py")
    valid = run(folder, sys.executable, records, "mc-valid", folder)
    expect(valid, f"^# DIS: {WORD:08x} {TEXT}$", "the assembler's tests")
    return records


def check_coverage(folder, records):
    """The new record has every kind of test; and one that has not would be named."""
    expect(run(folder, sys.executable, records, "coverage", folder), "^codegen: [0-9]+ records$", "the six kinds of test")
    kinds = os.path.join(folder, "test", "Inputs", "records", "kinds.py")
    whole = read(folder, kinds)
    with open(kinds, "w", encoding="utf-8") as file:
        file.write(whole.replace('        yield record_of(i), lines\n    yield None, ["attributes',
                                 '        if i.name != "vx_absdiff":\n            yield record_of(i), lines\n'
                                 '    yield None, ["attributes'))
    lacking = subprocess.run([sys.executable, records, "coverage", folder], text=True, stderr=subprocess.PIPE,
                             stdout=subprocess.DEVNULL)
    with open(kinds, "w", encoding="utf-8") as file:
        file.write(whole)
    if lacking.returncode != 1 or "codegen: nothing for VX_ABSDIFF" not in lacking.stderr:
        fail(f"a record without a test of code generation was not found: {lacking.stderr}")
    print("found where it is left out")


def check_simulator(folder):
    build = os.path.join(folder, "build", "simulator")
    # What is looked at does not depend on the optimiser, which would take half the time.
    run(folder, "cmake", "--preset", "dev", "-B", build, "-DCMAKE_CXX_FLAGS_RELWITHDEBINFO=-O0",
        "-DVORION_COMPONENTS=intrinsics;support;isasim")
    run(folder, "cmake", "--build", build, "-j2", "--target", "isasim-decode-words", "isasim_Isa_test",
        "isasim_Integer_test")
    programs = os.path.join(build, "bin")
    decoded = run(folder, os.path.join(programs, "isasim-decode-words"), input=f"{WORD:x}\n")
    if decoded != TEXT + "\n":
        fail(f"the simulator reads {WORD:08x} as '{decoded.strip()}', expected '{TEXT}'")
    print("found in the simulator's decoder")
    run(folder, os.path.join(programs, "isasim_Isa_test"))
    tested = run(folder, os.path.join(programs, "isasim_Integer_test"), "--gtest_filter=*AbsoluteDifference")
    expect(tested, r"\[  PASSED  \] 1 test", "the simulator's instructions")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--all", action="store_true")
    parser.add_argument("--sources", default=os.path.join(ROOT, "build", "sources"), help="unpacked sources")
    parser.add_argument("folder")
    options = parser.parse_args()
    folder = os.path.abspath(options.folder)
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(os.path.join(folder, "build"))
    for name in COPIED:
        copy = shutil.copytree if os.path.isdir(os.path.join(ROOT, name)) else shutil.copy2
        copy(os.path.join(ROOT, name), os.path.join(folder, name))
    os.symlink(os.path.abspath(options.sources), os.path.join(folder, "build", "sources"))

    *made, last = list(steps(read(folder, PAGE)))
    for kind, *step in made:
        if kind == "append":
            with open(os.path.join(folder, step[0]), "a", encoding="utf-8") as file:
                file.write("\n" + step[1])
            print(f"put into {step[0]}")
        else:
            run(folder, "bash", "-ec", step[0])
    records = check_generated(folder)
    check_coverage(folder, records)
    check_simulator(folder)
    if options.all:
        print(run(folder, "bash", "-ec", last[1])[-300:])
    return 0


if __name__ == "__main__":
    sys.exit(main())
