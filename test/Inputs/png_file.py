"""A PNG of 8 bits a channel from rows of bytes."""

import struct
import zlib

COLOUR_TYPES = {1: 0, 3: 2, 4: 6}  # by channels: grey, RGB, RGBA


def chunk(kind, body):
    return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))


def write(path, rows, channels):
    """rows: from the top, each of width times channels bytes."""
    # Each byte less the one of the pixel before: smooth pictures become small.
    lines = b"".join(b"\1" + row[:channels] + bytes((a - b) % 256 for a, b in zip(row[channels:], row)) for row in rows)
    head = struct.pack(">IIBBBBB", len(rows[0]) // channels, len(rows), 8, COLOUR_TYPES[channels], 0, 0, 0)
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(lines, 9)) + chunk(b"IEND", b""))
