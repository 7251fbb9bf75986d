"""Runs scripts/setup.sh while this process holds the locks of apt's lists and of dpkg, in a state of apt's that is the
test's own. Each lock is released when setup.sh says that it waits for it.
usage: package-locks.py FOLDER (with scripts/ and no state of apt's yet)"""
import fcntl
import os
import subprocess
import sys

folder = os.path.abspath(sys.argv[1])
for part in ("lists/partial", "cache/archives/partial", "parts", "dpkg", "bin"):
    os.makedirs(os.path.join(folder, part))
for empty in ("dpkg/status", "sources.list"):
    with open(os.path.join(folder, empty), "w", encoding="utf-8"):
        pass
config = os.path.join(folder, "apt.conf")
with open(config, "w", encoding="utf-8") as out:
    for key, place in (("State::Lists", "lists"), ("State::status", "dpkg/status"), ("Cache", "cache"), ("Log", "."),
                       ("Etc::sourcelist", "sources.list"), ("Etc::sourceparts", "parts")):
        out.write(f'Dir::{key} "{os.path.join(folder, place)}";\n')
# Nothing is installed, so it may run as anybody.
with open(os.path.join(folder, "bin", "id"), "w", encoding="utf-8") as out:
    os.fchmod(out.fileno(), 0o755)
    out.write("#!/bin/sh\necho 0\n")

held = {}
for name in ("lists/lock", "dpkg/lock-frontend"):
    held[name] = open(os.path.join(folder, name), "w", encoding="utf-8")
    fcntl.lockf(held[name], fcntl.LOCK_EX)
environment = dict(os.environ, APT_CONFIG=config, PATH=os.path.join(folder, "bin") + ":" + os.environ["PATH"])
with subprocess.Popen(["bash", os.path.join(folder, "scripts", "setup.sh")], env=environment, text=True,
                      stdout=subprocess.PIPE, stderr=subprocess.STDOUT) as setup:
    for line in setup.stdout:
        print(line, end="", flush=True)
        for name in [name for name in held if line.rstrip().endswith(name)]:
            held.pop(name).close()
print("exit code", setup.returncode)
