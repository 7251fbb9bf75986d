#!/usr/bin/env python3
"""Compares the time reports of regions, as region.test leaves them.

usage: same_times.py FOLDER [NAME [whole]]

Without NAME: cold and warm, and the launches that warm has in whole. NAME alone: it, reached and from the file. With
`whole`: it ends with that run, too.
"""

import json
import os
import sys


def times(folder, name):
    """(kernel, report) of the launches that were timed."""
    with open(os.path.join(folder, name + ".json")) as file:
        return [(r["name"], r["time"]) for r in json.load(file)["runs"] if r.get("time")]


def from_file(folder, name):
    ran = times(folder, name)
    assert ran and ran == times(folder, name + "-again"), f"{name}: {ran}"
    return ran


def main():
    folder = sys.argv[1]
    if len(sys.argv) > 2:
        named = from_file(folder, sys.argv[2])
        ends_whole = len(sys.argv) > 3
        assert not ends_whole or named == times(folder, sys.argv[3])[-len(named):]
        print(f"{len(named)} launches: the same from the file{', and in the whole run' if ends_whole else ''}")
        return
    cold, warm = from_file(folder, "cold"), from_file(folder, "warm")
    print(f"{len(cold)} launches: the same from the file")
    assert warm == times(folder, "whole")[7:12]
    print(f"{len(warm)} launches: the same from the file, and in the whole run")
    assert [name for name, _ in cold] == [name for name, _ in warm] and cold != warm
    print("cold and warmed up are different")


main()
