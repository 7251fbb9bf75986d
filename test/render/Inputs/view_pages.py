#!/usr/bin/env python3
"""Several pages of one `splat view`, and what stays when it ends.

usage: view_pages.py SCENE CAMERAS FOLDER
"""

import concurrent.futures
import json
import os
import signal
import socket
import sys
import threading
import time

from viewer import ask, camera, frame, viewer

SCENE, CAMERAS, FOLDER = sys.argv[1:]


def clocked(at, page, focal):
    """The status of a request for cycles of a view that nobody has asked for."""
    asked = {"camera": camera(CAMERAS) | {"fx": focal}, "clock": True}
    return ask(at, "POST", "/frame", json.dumps(asked).encode(), **{"X-Splat-Page": page})[0]


def check_pages(at):
    with concurrent.futures.ThreadPoolExecutor(8) as pool:
        # All of them at once, three times: each page gets its cycles.
        answers = [pool.submit(lambda n: [clocked(at, f"page-{n}", 40 + n + 0.1 * turn) for turn in range(3)], n) for n in range(3)]
        assert all(answer.result() == [200] * 3 for answer in answers), [answer.result() for answer in answers]
        # A page's newer request takes the place of its older one, and of nobody else's.
        for focal in range(50, 60):
            old = pool.submit(clocked, at, "a", focal)
            time.sleep(0.02)
            other, new = pool.submit(clocked, at, "b", focal + 0.2), pool.submit(clocked, at, "a", focal + 0.5)
            assert (other.result(), new.result()) == (200, 200)
            if old.result() == 409:
                break
        else:
            assert False, "no request was superseded"
    print("each page gets its cycles")


def check_strangers(at):
    slow = [socket.create_connection(("127.0.0.1", at.port)) for _ in range(200)]
    for connection in slow:
        connection.sendall(b"GET / HT")
    status, page, _ = ask(at, "GET", "/", token=False)
    assert status == 200 and b"<title>splat view" in page
    frame(at, {"camera": camera(CAMERAS)})
    print("slow connections keep nobody waiting")


def check_ends():
    """No temporary file stays, even of a measurement that goes on."""
    temporary = os.path.join(FOLDER, "temporary")
    os.mkdir(temporary)
    for number in (signal.SIGHUP, signal.SIGINT, signal.SIGTERM):
        signal.signal(number, signal.SIG_DFL)
        with viewer(SCENE, "--cameras", CAMERAS, ends_by=number, TMPDIR=temporary) as at:
            def measure(at=at):
                try:
                    clocked(at, "a", 61)
                except OSError:
                    pass  # the server ends first
            measured = threading.Thread(target=measure)
            measured.start()
            while not any("report" in name or "cameras" in name for _, _, names in os.walk(temporary) for name in names):
                time.sleep(0.01)
        measured.join()
        assert not os.listdir(temporary), (number, os.listdir(temporary))
    print("nothing stays")


with viewer(SCENE, "--cameras", CAMERAS) as running:
    check_pages(running)
    check_strangers(running)
check_ends()
