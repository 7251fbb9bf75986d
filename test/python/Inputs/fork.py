"""Draws in processes that are forked before and after the first machine is opened, and in those of multiprocessing."""
import multiprocessing
import os
import sys

import vorion


def draw(machine=None):
    scene, camera = vorion.Scene.read("s.ply"), vorion.Camera.read("c.json", "front")
    return (machine or vorion.Machine()).render(scene, camera).report["counts"]["visible"]


def attempt(what, call, *arguments):
    try:
        print(f"{what}: drew {call(*arguments)}", end="", flush=True)
    except vorion.Error as e:
        print(f"{what}: {type(e).__name__}: {e}", flush=True)


def ended(child):
    return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])


if __name__ == "__main__":
    child = os.fork()
    if child == 0:
        attempt("forked before", draw)
        sys.exit()
    print(f", ended with {ended(child)}", flush=True)
    machine = vorion.Machine()
    attempt("parent", draw, machine)
    print(flush=True)
    child = os.fork()
    if child == 0:
        attempt("forked after", draw, machine)
        attempt("a machine of its own", draw)
        sys.exit()  # which releases the machine
    print(f"forked after: ended with {ended(child)}", flush=True)
    for method in ("fork", "spawn"):
        with multiprocessing.get_context(method).Pool(1) as pool:
            attempt(f"multiprocessing {method}", pool.apply, draw)
    print(flush=True)
    attempt("parent", draw, machine)
    print(flush=True)
