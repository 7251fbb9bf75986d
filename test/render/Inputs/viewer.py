"""A `splat view` that runs, and what one asks its server."""

import contextlib
import http.client
import json
import os
import signal
import struct
import subprocess
import urllib.parse

# Who runs tests in the background may ignore it, which children inherit.
signal.signal(signal.SIGINT, signal.default_int_handler)


@contextlib.contextmanager
def viewer(scene, *options, ends_by=signal.SIGINT, **variables):
    """Gives a running viewer's address; it must end well at the signal."""
    process = subprocess.Popen(["splat", "view", scene, *options], stdout=subprocess.PIPE, text=True, env=os.environ | variables)
    try:
        said = process.stdout.readline()
        assert said.startswith("splat view: http://127.0.0.1:"), said
        yield urllib.parse.urlsplit(said.split()[-1])
        process.send_signal(ends_by)
        assert process.wait(30) == 0, process.returncode
    finally:
        process.kill()
        process.wait()


def ask(at, method, path, body=None, token=True, **headers):
    """Status, body and header lines of the answer."""
    connection = http.client.HTTPConnection("127.0.0.1", at.port, timeout=60)
    sent = {"Host": at.netloc, "Origin": f"http://{at.netloc}"} | ({"X-Splat-Token": at.fragment} if token else {}) | headers
    connection.putrequest(method, path, skip_host=True)
    for name, value in sent.items():
        if value is not None:
            connection.putheader(name, value)
    if body is not None:
        connection.putheader("Content-Length", str(len(body)))
    connection.endheaders(body)
    answer = connection.getresponse()
    return answer.status, answer.read(), answer.headers


def refused(answer, status):
    assert answer[0] == status, answer
    assert "\n" not in json.loads(answer[1])["error"]


def camera(cameras):
    """The first of a file's, as a request has it."""
    with open(cameras, encoding="utf-8") as f:
        view = json.load(f)[0]
    return {k: view[k] for k in ("width", "height", "position", "rotation", "fx", "fy")}


def frame(at, asked):
    """Facts and pixels of a frame."""
    status, answer, _ = ask(at, "POST", "/frame", json.dumps(asked).encode())
    assert status == 200, answer
    size, = struct.unpack("<I", answer[:4])
    facts, pixels = json.loads(answer[4:4 + size]), answer[4 + size:]
    assert len(pixels) == 4 * facts["width"] * facts["height"]
    return facts, pixels
