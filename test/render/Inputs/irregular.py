"""Puts a pipe in the place of each file of a folder, one by one, and a socket, a device, a folder and a dangling link in
that of some, and runs a command on the folder. It must end with exit code 3 and one line, and not wait. What it says is printed once for each kind.
usage: irregular.py FOLDER COMMAND... (the folder's name in it is FOLDER)"""
import os
import shutil
import socket
import subprocess
import sys

folder, command = sys.argv[1], sys.argv[2:]


def listen(path):
    # A socket's name must be short.
    here = os.getcwd()
    os.chdir(os.path.dirname(path))
    with socket.socket(socket.AF_UNIX) as server:
        server.bind(os.path.basename(path))
    os.chdir(here)


kinds = {
    "pipe": os.mkfifo,
    "socket": listen,
    "device": lambda path: os.symlink("/dev/zero", path),
    "folder": os.mkdir,
    "link to nothing": lambda path: os.symlink("nothing", path),
}
files = sorted(os.path.join(top, name) for top, _, names in os.walk(folder) for name in names)
for kind, make in kinds.items():
    refused, tried = 0, files if kind == "pipe" else files[::6]
    for path in tried:
        os.rename(path, path + ".aside")
        make(path)
        done = subprocess.run(command, capture_output=True, text=True, timeout=60, check=False)
        lines = done.stderr.splitlines()
        # Without one of its pictures a capture is smaller.
        is_smaller = done.returncode == 0 and kind == "link to nothing"
        if is_smaller or (done.returncode == 3 and len(lines) == 1 and lines[0].startswith("splat: error: ")):
            refused += 1
        else:
            print(f"{kind} {path}: {done.returncode}: {done.stderr}")
        shutil.rmtree(path) if kind == "folder" else os.remove(path)
        os.rename(path + ".aside", path)
    print(f"{kind}: {refused} of {len(tried)} files")
