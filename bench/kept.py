"""Results that benchmarks keep in files: they are used again only where everything that made them is the same."""

import functools
import hashlib
import json
import os
import subprocess
import sys

import scenes


@functools.cache
def programs():
    """A hash of the programs and libraries that a result depends on, as splat says it."""
    said = subprocess.run(["splat", "--version"], check=True, capture_output=True, text=True).stdout
    return said.split()[-1]


@functools.cache
def content(path):
    """A hash of a file, or of the names and contents of all files in a folder; paths are as seen from the root."""
    path = os.path.join(scenes.ROOT, path)
    digest = hashlib.sha256()
    files = [path] if not os.path.isdir(path) else sorted(
        os.path.join(folder, name) for folder, _, names in os.walk(path) for name in names)
    for file in files:
        digest.update(os.path.relpath(file, path).encode())
        with open(file, "rb") as f:
            digest.update(hashlib.sha256(f.read()).digest())
    return digest.hexdigest()[:16]


def origin(inputs, options):
    """What a result is made from: contents of files and folders by what they are, and options; programs and machine too."""
    machine = {}
    for name in ("VORION_CONFIG", "VORION_SET"):
        value = os.environ.get(name, "")
        machine[name] = content(value) if os.path.isfile(value) else value
    return {"programs": programs(), "machine": machine, **{what: content(path) for what, path in inputs.items()},
            "options": list(options)}


def differences(had, wanted):
    """The names of what differs."""
    return [name for name, value in wanted.items() if not isinstance(had, dict) or had.get(name) != value]


def say_stale(file, had, wanted):
    print(f"{file}: stale, differs in {', '.join(differences(had, wanted))}: made again", file=sys.stderr, flush=True)


def hashes(files):
    """Of the contents of files; None where one is missing."""
    found = []
    for file in files:
        try:
            with open(file, "rb") as f:
                found.append(hashlib.sha256(f.read()).hexdigest())
        except FileNotFoundError:
            return None
    return found


def is_kept(files, made_from):
    """Whether once() has left the files, made from the same; those that are stale are named."""
    try:
        with open(files[0] + ".origin", encoding="utf-8") as f:
            had = json.load(f)
    except (FileNotFoundError, json.JSONDecodeError):
        return False
    if not isinstance(had, dict) or had.get("files") != hashes(files):
        return False
    if not differences(had.get("made_from"), made_from):
        return True
    say_stale(files[0], had.get("made_from"), made_from)
    return False


def once(files, made_from, make):
    """Calls make(), which writes the files, unless an earlier call with the same made_from did. What they were made
    from is beside the first one, with the ending .origin."""
    beside = files[0] + ".origin"
    if is_kept(files, made_from):
        return
    if os.path.exists(beside):
        os.remove(beside)
    make()
    with open(beside + ".new", "w", encoding="utf-8") as f:
        json.dump({"made_from": made_from, "files": hashes(files)}, f)
    os.replace(beside + ".new", beside)


def result(file, made_from, make):
    """The JSON in a file; make() returns it the first time."""
    def write():
        with open(file + ".new", "w", encoding="utf-8") as f:
            json.dump(make(), f, indent=1)
        os.replace(file + ".new", file)
    once([file], made_from, write)
    with open(file, encoding="utf-8") as f:
        return json.load(f)
