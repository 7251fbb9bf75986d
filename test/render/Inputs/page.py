#!/usr/bin/env python3
"""Opens a page that splat wrote in headless Chromium, from its file and without a network.

usage: page.py PAGE.html [--dark]
With #test a page tries itself (its script's tryOut): it selects, changes every control, and becomes narrow and wide.
Checked here: what it said, that no script error reached the browser's log, and that a screenshot shows something.
"""

import os
import re
import struct
import subprocess
import sys
import tempfile
import zlib

page = os.path.abspath(sys.argv[1])
dark = sys.argv[2:] == ["--dark"]


def chromium(folder, *options):
    # Offline: everything that would call out is off, and names resolve to nothing.
    return subprocess.run(
        ["chromium", "--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
         "--disable-background-networking", "--disable-component-update", "--disable-sync", "--disable-dev-shm-usage",
         "--host-resolver-rules=MAP * ~NOTFOUND", "--enable-logging=stderr", "--v=0", f"--user-data-dir={folder}/user",
         *(["--blink-settings=preferredColorScheme=0"] if dark else []), *options, f"file://{page}#test"], check=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def pixels(file):
    """The decoded rows of a PNG of 8 bits a channel."""
    with open(file, "rb") as f:
        data = f.read()
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    at, body = 8, b""
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        if kind == b"IDAT":
            body += data[at + 8:at + 8 + size]
        at += 12 + size
    return zlib.decompress(body)


with open(page, encoding="utf-8") as f:
    text = f.read()
outside = re.search(r"""(src|href)=["']?(https?:)?//|@import|url\(["']?https?:|\bfetch\(|XMLHttpRequest|WebSocket""", text)
assert not outside, f"the page loads {outside}"
with tempfile.TemporaryDirectory() as folder:
    shot = os.path.join(folder, "shot.png")
    # Both of one start, which takes longer than the page.
    dumped = chromium(folder, "--dump-dom", f"--screenshot={shot}", "--window-size=1200,900")
    assert 'data-test="passed with ' in dumped.stdout, dumped.stdout[:300] + dumped.stderr[-2000:]
    if "color-scheme: light dark" in text:
        assert f', {"dark" if dark else "light"}"' in dumped.stdout, dumped.stdout[:300]
    # A script's complaints are logged as CONSOLE.
    complaints = [line for line in dumped.stderr.splitlines() if "CONSOLE" in line]
    assert not complaints, complaints
    assert len(set(pixels(shot))) > 16, "the screenshot shows nothing"
print("the page works")
