"""Runs scripts/clang-tidy.py on a project of two files that include one header, and changes them.
usage: changed.py ROOT BUILD FOLDER; prints what each run says."""

import json
import os
import shutil
import subprocess
import sys

root, build, folder = sys.argv[1:]
support, made = os.path.join(folder, "support"), os.path.join(folder, "build")


def write(name, text):
    with open(os.path.join(support, name), "w", encoding="utf-8") as file:
        file.write(text)


def lint(what, *options):
    command = [sys.executable, os.path.join(root, "scripts", "clang-tidy.py"), made, folder, *options]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    print(f"{what}: exit code {done.returncode}")
    print(done.stdout + done.stderr, end="", flush=True)


os.makedirs(support)
os.makedirs(made)
os.symlink(os.path.join(build, "lib"), os.path.join(made, "lib"))
shutil.copy(os.path.join(root, ".clang-tidy"), folder)
write("Sum.h", "int sum(int A, int B);\n")
for name in ("First", "Second"):
    write(name + ".cpp", f'#include "Sum.h"\nint the{name}() {{ return sum(1, 2); }}\n')
with open(os.path.join(made, "compile_commands.json"), "w", encoding="utf-8") as file:
    json.dump([{"directory": made, "file": os.path.join(support, f"{name}.cpp"),
                "command": f"clang++-19 -std=c++20 -c {support}/{name}.cpp -o {name}.o"} for name in ("First", "Second")], file)

lint("at first")
lint("again")
lint("no time", "--all", "--seconds", "0")
lint("all", "--all")
write("First.cpp", '#include "Sum.h"\nint theFirst() { return sum(1, 3); }\n')
lint("one file changed")
write("Sum.h", "int sum(int A, int B);\nint product(int A, int B);\n")
lint("their header changed")
write("Second.cpp", '#include "Sum.h"\nint The_Second() { return sum(1, 2); }\n')
lint("one became wrong")
lint("it stays wrong")
with open(os.path.join(folder, ".clang-tidy"), "a", encoding="utf-8") as file:
    file.write("# other checks\n")
lint("the checks changed")
