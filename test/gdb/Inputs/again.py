"""Connects to the port of vorion-sim's log, as gdb does that had to wait: with one packet three times."""

import re
import socket
import sys
import time

while not (found := re.search(r"port (\d+)", open(sys.argv[1]).read())):
    time.sleep(0.05)


def packet(text):
    return f"${text}#{sum(text.encode()) % 256:02x}".encode()


with socket.create_connection(("127.0.0.1", int(found[1])), timeout=60) as server:
    server.sendall(3 * packet("qSupported:swbreak+") + packet("vMustReplyEmpty"))
    received = b""
    while not received.endswith(b"$#00"):
        more = server.recv(4096)
        assert more, received
        received += more
    print(received.decode())
    server.sendall(b"+" + packet("k"))
