#!/usr/bin/env python3
"""Sends whole, damaged, half, slow, endless and pipelined requests to a running `splat view`, many at a time.

usage: view_sockets.py SCENE [--rounds N] [--seconds N] [--seed N]

A round is some sixty connections, drawn from its seed. After each round the server must be alive, its memory bounded,
and a legal client answered. No answer may hold the token. The last line says what was done; a fault prints the seed of
its round and ends with 1.
"""

import argparse
import collections
import http.client
import json
import random
import select
import signal
import socket
import struct
import subprocess
import sys
import time
import urllib.parse

MOST_GROWTH = 256 << 10  # KiB above what the server has after its first picture
MOST_SLOW = 300          # connections that stay for the next rounds
ROUND_SECONDS = 1.5

CAMERA = {"width": 48, "height": 32, "fx": 40, "fy": 40, "position": [0, 0, -4], "rotation": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]}
WORDS = [b"\r\n", b"\n", b"\r", b"\0", b" ", b":", b"%", b"%00", b"..", b"/", b"?", b"#", b"\xff", b"HTTP/1.1", b"HTTP/9.9", b"-1", b"0",
         b"18446744073709551616", b"1073741824", b"1e999", b"chunked", b"Transfer-Encoding: chunked\r\n", b"Content-Length: 5\r\n",
         b"Content-Length: -1\r\n", b"Expect: 100-continue\r\n", b"Upgrade: websocket\r\n", b"Host: x\r\n", b"{", b"[" * 200, b'"', b"a" * 300]


class Fault(Exception):
    pass


class Server:
    def __init__(self, scene):
        signal.signal(signal.SIGINT, signal.SIG_DFL)
        # pylint: disable-next=consider-using-with
        self.process = subprocess.Popen(["splat", "view", scene, "--size", "96x64"], stdout=subprocess.PIPE, text=True)
        said = self.process.stdout.readline()
        if not said.startswith("splat view: http://"):
            sys.exit(f"splat view printed '{said}'")
        at = urllib.parse.urlsplit(said.split()[-1])
        self.port, self.host, self.token = at.port, at.netloc, at.fragment
        with open(scene, "rb") as f:
            self.scene = f.read(1 << 16)
        self.check(draws=True)
        self.first = self.memory()
        self.most = 0

    def memory(self):
        """KiB that the server has."""
        with open(f"/proc/{self.process.pid}/status", encoding="ascii") as f:
            return next(int(line.split()[1]) for line in f if line.startswith("VmRSS:"))

    def request(self, method, path, body=None, token=True, **more):
        fields = {"Host": self.host, "Origin": f"http://{self.host}", "X-Splat-Page": "legal"} | more
        if token:
            fields["X-Splat-Token"] = self.token
        if body is not None:
            fields.setdefault("Content-Length", str(len(body)))
        head = "".join(f"{name}: {value}\r\n" for name, value in fields.items() if value is not None)
        return f"{method} {path} HTTP/1.1\r\n{head}\r\n".encode() + (body or b"")

    def legal(self, method, path, body=None):
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=60)
        fields = {"Host": self.host, "Origin": f"http://{self.host}", "X-Splat-Token": self.token, "X-Splat-Page": "legal"}
        connection.request(method, path, body, fields)
        answer = connection.getresponse()
        text = answer.read()
        connection.close()
        if answer.status != 200:
            raise Fault(f"{method} {path} of a legal client has {answer.status}: {text[:200]}")

    def check(self, draws):
        if self.process.poll() is not None:
            raise Fault(f"splat view has ended with {self.process.returncode}")
        try:
            self.legal("GET", "/")
            self.legal("GET", "/scene")
            if draws:
                self.legal("POST", "/frame", json.dumps({"camera": CAMERA}))
        except (OSError, http.client.HTTPException) as problem:
            raise Fault(f"a legal client gets no answer: {problem!r}") from problem

    def check_memory(self):
        now = self.memory()
        self.most = max(self.most, now)
        if now > self.first + MOST_GROWTH:
            raise Fault(f"splat view has {now >> 10} MiB, and had {self.first >> 10} MiB")

    def end(self):
        self.process.send_signal(signal.SIGINT)
        if self.process.wait(60) != 0:
            raise Fault(f"at Ctrl-C, splat view ended with {self.process.returncode}")


def damaged(chance, text):
    data = bytearray(text)
    for _ in range(chance.choice((1, 1, 2, 4, 16))):
        at = chance.randrange(len(data) + 1)
        kind = chance.randrange(5)
        if kind == 0 and data:
            data[at % len(data)] ^= 1 << chance.randrange(8)
        elif kind == 1:
            data[at:at] = chance.choice(WORDS)
        elif kind == 2:
            del data[at:at + chance.choice((1, 2, 8, 64))]
        elif kind == 3:
            data[at:at] = data[at:at + chance.choice((4, 40, 400))] * chance.choice((1, 2, 50))
        elif data:
            data[at % len(data)] = chance.randrange(256)
    return bytes(data)


def chunked(chance, body):
    pieces = []
    while body:
        size = chance.randint(1, len(body))
        pieces.append(b"%x\r\n%s\r\n" % (size, body[:size]))
        body = body[size:]
    return b"".join(pieces) + b"0\r\n\r\n"


def whole(server, chance):
    """A request that means what it says, with or without what lets it in."""
    token, page = chance.random() < 0.5, f"page-{chance.randrange(20)}"
    kind = chance.randrange(6)
    asked = {"camera": CAMERA, "layer": chance.choice(("picture", "depth", "error")), "clock": chance.random() < 0.02, "x": 3, "y": 5}
    if kind == 0:
        return server.request("GET", chance.choice(("/", "/main.js", "/none", "/scene?x=1")), token=False)
    if kind == 1:
        return server.request("GET", "/scene", token=token)
    if kind == 2 and chance.random() < 0.1:
        return server.request("POST", "/scene?name=x%20%00.ply", server.scene if chance.random() < 0.5 else damaged(chance, server.scene), token)
    body = json.dumps(asked).encode()
    path = "/frame" if kind < 5 else "/pixel"
    fields = {"X-Splat-Page": page}
    if chance.random() < 0.2:
        return server.request("POST", path, chunked(chance, body), token, **fields, **{"Content-Length": None, "Transfer-Encoding": "chunked"})
    return server.request("POST", path, body, token, **fields)


def endless(server, chance):
    """Gives pieces without an end."""
    token = chance.random() < 0.5
    kind = chance.randrange(5)
    if kind == 0:
        yield b"GET / HTTP/1.1\r\n"
        while True:
            yield b"".join(b"X-%d: %s\r\n" % (chance.randrange(10**9), b"a" * chance.randrange(2000)) for _ in range(20))
    if kind == 1:
        yield b"GET /"
        while True:
            yield b"a" * 8000
    if kind == 2:
        while True:
            yield chance.randbytes(4096)
    yield server.request("POST", chance.choice(("/frame", "/scene")), None, token, **{"Transfer-Encoding": "chunked"})
    while True:
        yield b"800\r\n" + b"x" * 2048 + b"\r\n" if kind == 3 else b"1;" + b"a" * 4000


class Connection:
    """What one client sends, and how it ends."""

    def __init__(self, server, chance):
        self.kind = chance.choice(("whole", "damaged", "damaged", "damaged", "half", "pipelined", "slow", "endless", "large", "noise"))
        self.pieces, self.slow, self.ending = [], False, chance.choice(("wait", "wait", "close", "shutdown", "reset"))
        text = whole(server, chance)
        if self.kind == "damaged":
            text = damaged(chance, text)
        elif self.kind == "half":
            text = text[:chance.randrange(len(text))]
        elif self.kind == "pipelined":
            text = b"".join(whole(server, chance) for _ in range(chance.randint(2, 20)))
        elif self.kind == "large":
            text = server.request("POST", "/frame", None, chance.random() < 0.5, **{"Content-Length": chance.choice((1 << 16, 1 << 30, 1 << 63))})
            text += b"x" * chance.choice((0, 1000, 1 << 20))
        elif self.kind == "noise":
            text = chance.randbytes(chance.choice((1, 10, 1000, 10000)))
        if self.kind == "endless":
            self.pieces = endless(server, chance)
        elif self.kind == "slow":
            self.slow = True
            self.pieces = iter([text[:chance.randrange(40)]] + [text[at:at + 1] for at in range(len(text))])
        else:
            size = chance.choice((len(text) or 1, 1000, 7))
            self.pieces = iter([text[at:at + size] for at in range(0, len(text), size)])
        self.rest, self.answer, self.done, self.steps = b"", b"", False, 0
        self.socket = socket.socket()
        self.socket.setblocking(False)
        self.socket.connect_ex(("127.0.0.1", server.port))

    def write(self):
        """Sends what can be sent; False at the end."""
        self.steps += 1
        if self.kind == "endless" and self.steps > 400:
            return False
        if not self.rest:
            self.rest = next(self.pieces, None)
            if self.rest is None:
                self.rest = b""
                return False
        self.rest = self.rest[self.socket.send(self.rest):]
        return True

    def end(self):
        if self.ending == "reset":
            self.socket.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
        self.socket.close()


def drive(server, connections, seconds, tally):
    """Until all are done; gives the slow ones that are not."""
    end = time.monotonic() + seconds
    sends = {c.socket.fileno(): c for c in connections}
    waits = dict(sends)
    poll = select.poll()
    for number in sends:
        poll.register(number, select.POLLIN | select.POLLOUT)

    def close(number):
        poll.unregister(number)
        sends.pop(number, None)
        done = waits.pop(number)
        check_answer(server, done.answer, tally)
        done.end()

    stepped = set()
    while waits and time.monotonic() < end and any(not c.slow for c in waits.values()):
        for number, events in poll.poll(50):
            own = waits[number]
            try:
                if events & (select.POLLIN | select.POLLHUP | select.POLLERR):
                    got = own.socket.recv(1 << 16)
                    own.answer += got[:max(0, 4096 - len(own.answer))]
                    if not got:
                        close(number)
                        continue
                if events & select.POLLOUT and number in sends and not (own.slow and number in stepped):
                    if own.slow:
                        stepped.add(number)
                        poll.modify(number, select.POLLIN)
                    if not own.write():
                        del sends[number]
                        poll.modify(number, select.POLLIN)
                        if own.ending in ("close", "reset"):
                            close(number)
                        elif own.ending == "shutdown":
                            own.socket.shutdown(socket.SHUT_WR)
            except OSError:
                tally["ended by the server"] += 1
                close(number)
    slow = [c for c in waits.values() if c.slow]
    for number in [n for n, c in waits.items() if not c.slow]:
        tally["without an end"] += 1
        close(number)
    return slow


def check_answer(server, answer, tally):
    if server.token.encode() in answer:
        raise Fault(f"an answer holds the token: {answer[:500]!r}")
    if answer and not answer.startswith(b"HTTP/1.1 "):
        raise Fault(f"an answer is not HTTP: {answer[:500]!r}")
    tally[answer[9:12].decode() if answer else "no answer"] += 1


def run(server, options, tally):
    """Gives the number of rounds."""
    slow, begun, said = [], time.monotonic(), 0
    for number in range(options.rounds or sys.maxsize):
        seed = options.seed + number
        chance = random.Random(seed)
        try:
            many = 300 if chance.random() < 0.02 else 60
            connections = [Connection(server, chance) for _ in range(many)]
            tally["connections"] += many
            slow = drive(server, connections + slow, ROUND_SECONDS, tally)
            while len(slow) > MOST_SLOW:
                slow.pop(0).end()
            server.check_memory()
            server.check(draws=number % 10 == 0)
        except Fault as fault:
            sys.exit(f"seed {seed}: {fault}")
        now = time.monotonic() - begun
        if now > options.seconds:
            return number + 1
        if now - said > 300:
            said = now
            print(f"{now:.0f} s: {number + 1} rounds, {tally['connections']} connections, memory {server.memory() >> 10} MiB", flush=True)
    return options.rounds


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene")
    parser.add_argument("--rounds", type=int, default=0, help="0: until --seconds are over")
    parser.add_argument("--seconds", type=float, default=float("inf"))
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    server = Server(options.scene)
    tally = collections.Counter()
    try:
        rounds = run(server, options, tally)
        server.end()
    except Fault as fault:
        sys.exit(str(fault))
    finally:
        server.process.kill()
    connections = tally.pop("connections")
    print(", ".join(f"{what} {many}" for what, many in sorted(tally.items())))
    print(f"{rounds} rounds, {connections} connections: splat view answers, and had at most {server.most >> 10} MiB ({server.first >> 10} MiB before)")


if __name__ == "__main__":
    main()
