"""private_memory.py BUILD FOLDER: runs the kernels of private_memory.cl with
private memory of many sizes, groups of many sizes, and both engines."""
import pathlib
import subprocess
import sys

build, folder = map(pathlib.Path, sys.argv[1:])
source = pathlib.Path(__file__).with_suffix(".cl")
CALLED = ["plain", "called", "several", "apart", "kept", "printed"]
# Words, every which is used, the optimisation, kernels, and groups as (global, local).
RUNS = [
    (256, 1, "-O2", CALLED, [(1, 1), (2560, 64), (512, 256)]),
    (256, 1, "-O0", CALLED, [(512, 64)]),
    (16600, 7, "-O2", CALLED, [(16, 16), (128, 16), (100, 50)]),
    (25600, 31, "-O0", ["plain", "called", "kept"], [(128, 16)]),
    (25600, 31, "-O2", CALLED, [(40, 1), (256, 128)]),
    (524288, 509, "-O2", CALLED, [(128, 16)]),
]


def run(elf, kernel, shape, words, settings):
    items, local = shape
    out = folder / "out"
    done = subprocess.run(
        [build / "bin/vorion-sim", elf, "--kernel", kernel, "--global", str(items), "--local", str(local),
         *(["--set", settings] if settings else []), "--arg", f"out:{4 * items}@{out}", "--arg", f"i32:{words}"],
        capture_output=True, text=True)
    text = "".join(f"item {i} of {words} words\n" for i in [3] if kernel == "printed" and items > 3)
    good = done.returncode == 0 and done.stdout == text and out.read_bytes() == b"\1\0\0\0" * items
    if not good:
        print("WRONG", words, kernel, shape, settings, done.returncode, done.stdout[:200], done.stderr[:500])
    return good


def compile_kernels(words, step, level):
    elf = folder / f"{words}{level}.elf"
    subprocess.run([build / "bin/vorion-clang", level, f"-DN={words}", f"-DSTEP={step}", source, "-o", elf], check=True)
    return elf


right = 0
for words, step, level, kernels, shapes in RUNS:
    elf = compile_kernels(words, step, level)
    for kernel in kernels:
        for shape in shapes:
            right += run(elf, kernel, shape, words, "")
        right += run(elf, kernel, shapes[-1], words, "engine=interpreter")
        right += run(elf, kernel, shapes[-1], words, "engine=translator-avx2")
    right += run(elf, "plain", (512, 16), words, "warps_per_core=4")
print(right, "right")
