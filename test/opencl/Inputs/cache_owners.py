#!/usr/bin/env python3
"""What a program makes of a kernel cache that another user may own, with two
users beside root: cache_owners.py FOLDER. Root starts it. The victim has a home
that is not there, the attacker has no entry among the users."""

import os
import shutil
import subprocess
import sys

VICTIM, ATTACKER = 65534, 12345
folder = os.path.abspath(sys.argv[1])
temporary = os.path.join(folder, "tmp")


def make(name, owner=VICTIM, mode=0o755):
    path = os.path.join(folder, name)
    os.makedirs(path, exist_ok=True)
    os.chown(path, owner, owner)
    os.chmod(path, mode)
    return path


def run(user=VICTIM, program=("sample-vecadd",), **variables):
    """Code and output of a program whose environment has these alone."""
    environment = {name: os.environ[name] for name in ("PATH", "OCL_ICD_VENDORS", "VORION_ROOT")}
    environment |= {"TMPDIR": temporary, "VORION_SYSTEM_CACHE": os.path.join(folder, "system")} | variables
    done = subprocess.run(program, env=environment, cwd=folder, user=user, group=user, extra_groups=[],
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    return done.returncode, done.stdout


def files(path, suffix=""):
    return [os.path.join(at, name) for at, _, names in os.walk(path) for name in names if name.endswith(suffix)]


def say(case, **expected):
    """Prints the case, and what of its facts is not as expected."""
    wrong = [f"{fact} is {value!r}, expected {wanted!r}" for fact, (value, wanted) in expected.items() if value != wanted]
    print(f"{case}: {'; '.join(wrong) or 'ok'}", flush=True)


def refused(case, cache, why):
    code, output = run(POCL_CACHE_DIR=cache)
    say(case, code=(code != 0, True), reason=(why in output, True), files=(len(files(cache)), 0))


def private(case, why, **others):
    """The kernel is compiled for this run alone, with a warning, and nothing is left."""
    code, output = run(**others)
    say(case, code=(code, 0), output=(output.count("vorion: warning: kernel cache: ") == 1 and why in output, True),
        left=(os.listdir(temporary), []))


def kept(case, cache, **variables):
    """The kernel is kept in the folder."""
    code, output = run(**variables)
    say(case, code=(code, 0), output=("warning" in output, False), kept=(len(files(cache, ".elf")), 1))


def places():
    private("no HOME", "/nonexistent: cannot be made")
    private("empty HOME", "/nonexistent: cannot be made", HOME="")
    private("relative HOME", "/nonexistent: cannot be made", HOME="home")
    private("HOME that is not there", "/nonexistent: cannot be made", HOME="/nonexistent")
    private("HOME that cannot be written", "Permission denied", HOME=make("roots", 0))
    private("HOME of another user", "belongs to user 12345", HOME=make("theirs", ATTACKER, 0o777))
    private("HOME in a folder that others can write", "can be written by other users",
            HOME=(make("open", 0, 0o777), make("open/home"))[1])
    private("processes that only look for devices", "/nonexistent: cannot be made", program=("splat", "doctor"))
    home = make("home")
    kept("HOME", os.path.join(home, ".cache/pocl/kcache"), HOME=home)
    shutil.rmtree(os.path.join(home, ".cache"))
    kept("empty variables", os.path.join(home, ".cache/pocl/kcache"), HOME=home, POCL_CACHE_DIR="", XDG_CACHE_HOME="",
         POCL_KERNEL_CACHE="", VORION_ROOT="", POCL_DEVICES="", VORION_CAPTURE="",
         VORION_REMARKS="", VORION_COMPILE_ALL="", VORION_SYSTEM_CACHE="", VORION_TOOL_SERVERS="", TMPDIR="")


def named_folders():
    theirs = make("their-cache", ATTACKER, 0o777)
    refused("folder of another user", theirs, f"{theirs} belongs to user 12345")
    group = make("group", 0)
    os.chown(group, 0, ATTACKER)
    os.chmod(group, 0o775)
    refused("folder in one that a group can write", make("group/cache"), f"{group} can be written by other users")
    refused("folder that all can write", make("all", VICTIM, 0o777), "all can be written by other users")
    # As in /tmp.
    shared = make("shared", 0, 0o1777)
    link = os.path.join(shared, "link")
    os.symlink(theirs, link)
    os.lchown(link, VICTIM, VICTIM)
    refused("link to a folder of another user", link, f"{theirs} belongs to user 12345")
    own = os.path.join(shared, "own")
    kept("folder in one that is shared", own, POCL_CACHE_DIR=own)
    os.symlink(own, os.path.join(folder, "to-own"))
    kept("link to the user's own folder", own, POCL_CACHE_DIR=os.path.join(folder, "to-own"))
    old = make("tmp/pocl", ATTACKER)
    shutil.copytree(own, os.path.join(old, "kcache"))
    for path in [old, *files(old)]:
        os.chown(path, ATTACKER, ATTACKER)
    code, output = run()
    say("folder of a fixed name among temporary files", code=(code, 0), output=("/nonexistent" in output, True))
    shutil.rmtree(old)


def entries():
    cache = make("entries")
    run(POCL_CACHE_DIR=cache)
    theirs = make("their-files", ATTACKER)
    for way in ("hard link", "symbolic link", "pipe", "writable by the group"):
        changed = [path for path in files(cache) if os.path.basename(path) != "last_accessed" and not path.endswith(".log")]
        for number, path in enumerate(changed):
            copy = os.path.join(theirs, str(number))
            shutil.copyfile(path, copy)
            os.chown(copy, ATTACKER, ATTACKER)
            os.chmod(copy, 0o644)
            if way == "writable by the group":
                os.chmod(path, 0o660)
                continue
            os.remove(path)
            if way == "pipe":
                os.mkfifo(path, 0o600)
                os.chown(path, VICTIM, VICTIM)
            else:
                (os.link if way == "hard link" else os.symlink)(copy, path)
        code, output = run(POCL_CACHE_DIR=cache)
        again = [path for path in changed if output.count(f"{path} is damaged")]
        states = [os.lstat(path) for path in again]
        say(f"{way} in the cache", code=(code, 0), images=(len([path for path in again if path.endswith(".elf")]), 1),
            owners=({state.st_uid for state in states}, {VICTIM}), modes=({state.st_mode for state in states}, {0o100600}))


def system():
    of_system = make("system", 0)
    run(user=0, POCL_CACHE_DIR=of_system)

    def use(case, compiled):
        cache = make("user")
        # The compiler tells what it inlined.
        code, output = run(POCL_CACHE_DIR=cache, VORION_REMARKS="-Rpass=inline")
        say(case, code=(code, 0), warning=("warning" in output, False), compiled=("remark: " in output, compiled),
            images=(len(files(cache, ".elf")), 1))
        shutil.rmtree(cache)

    use("system's cache that others cannot read", True)
    subprocess.run(["chmod", "-R", "a+rX", of_system], check=True)
    use("system's cache", False)
    [image] = files(of_system, ".elf")
    os.chmod(image, 0o664)
    use("image of the system's that a group can write", True)
    os.chmod(image, 0o644)
    os.chown(image, ATTACKER, ATTACKER)
    use("image of the system's that is another user's", True)
    os.chown(image, 0, 0)
    os.chmod(os.path.dirname(image), 0o777)
    use("image in a folder that others can write", True)
    os.chmod(os.path.dirname(image), 0o755)
    os.chown(of_system, ATTACKER, ATTACKER)
    use("system's cache of another user", True)


shutil.rmtree(folder, ignore_errors=True)
make("", 0)
make("tmp", 0, 0o1777)
places()
named_folders()
entries()
system()
