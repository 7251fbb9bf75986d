#!/usr/bin/env python3
"""Pictures of every format and with every chunk about colour: splat reads the stored values.

usage: stored_values.py grid FOLDER                 PNGs of each colour type, depth and chunk, written here
       stored_values.py wrapped FOLDER PICTURE...   JPEG and WebP files with segments about colour and orientation
       stored_values.py peers FOLDER                PIL and OpenCV read the files that grid and wrapped left
"""

import os
import struct
import subprocess
import sys
import zlib

import numpy as np

WIDTH, HEIGHT = 7, 5
GREY, RGB, PALETTE, GREY_ALPHA, RGBA = 0, 2, 3, 4, 6
SAMPLES = {GREY: 1, RGB: 3, PALETTE: 1, GREY_ALPHA: 2, RGBA: 4}
DEPTHS = {GREY: (1, 2, 4, 8, 16), RGB: (8, 16), PALETTE: (1, 2, 4, 8), GREY_ALPHA: (8, 16), RGBA: (8, 16)}


def profile(space):
    """An ICC profile of a header and one tag, which libpng accepts."""
    tag = np.random.default_rng(1).bytes(256)
    header = bytearray(144)
    struct.pack_into(">I", header, 0, len(header) + len(tag))
    header[8:12] = b"\x02\x10\0\0"
    header[12:24] = b"mntr" + space + b"XYZ "
    header[36:40] = b"acsp"
    struct.pack_into(">3I", header, 68, 0xF6D6, 0x10000, 0xD32D)
    struct.pack_into(">I4s2I", header, 128, 1, b"desc", len(header), len(tag))
    return bytes(header) + tag


EXIF_TURNED = b"II*\0\x08\0\0\0\x01\0\x12\x01\x03\0\x01\0\0\0\x06\0\0\0\0\0\0\0"


def color_chunks(space):
    """Chunks before the palette that describe what the values mean, or how they are shown."""
    gamma = lambda g: (b"gAMA", struct.pack(">I", g))
    primaries = (b"cHRM", struct.pack(">8I", 31270, 32900, 64000, 33000, 30000, 60000, 15000, 6000))
    icc = (b"iCCP", b"any\0\0" + zlib.compress(profile(space)))
    return {"plain": [], "gamma-linear": [gamma(100000)], "gamma-2.2": [gamma(45455)], "gamma-1.8": [gamma(55556), primaries],
            "primaries": [primaries], "srgb": [(b"sRGB", b"\0")], "srgb-gamma": [(b"sRGB", b"\1"), gamma(45455), primaries],
            "icc": [icc], "icc-damaged": [(b"iCCP", b"any\0\0" + b"no stream")], "gamma-zero": [gamma(0)],
            "video": [(b"cICP", b"\x09\x10\0\1")], "exif": [(b"eXIf", EXIF_TURNED)],
            "density": [(b"pHYs", struct.pack(">2IB", 3000, 1000, 1))]}


def chunk(kind, content):
    return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))


def packed(samples, depth):
    """The rows of samples (H, W * channels) as PNG stores them, each after its filter."""
    rows = b""
    for row in samples:
        if depth == 16:
            data = row.astype(">u2").tobytes()
        else:
            bits = np.unpackbits(row.astype("u1")[:, None], axis=1)[:, 8 - depth:]
            data = np.packbits(bits.reshape(-1)).tobytes()
        rows += b"\0" + data
    return rows


ADAM7 = [(0, 0, 8, 8), (4, 0, 8, 8), (0, 4, 4, 8), (2, 0, 4, 4), (0, 2, 2, 4), (1, 0, 2, 2), (0, 1, 1, 2)]


def png(samples, kind, depth, before, after, interlaced):
    if interlaced:
        rows = b"".join(packed(part.reshape(part.shape[0], -1), depth)
                        for x, y, dx, dy in ADAM7 for part in [samples[y::dy, x::dx]] if part.size)
    else:
        rows = packed(samples.reshape(HEIGHT, -1), depth)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">2I5B", WIDTH, HEIGHT, depth, kind, 0, 0, interlaced)) +
            b"".join(chunk(*c) for c in before) + b"".join(chunk(*c) for c in after) +
            chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def write_png(folder, kind, depth, name, before, transparent, interlaced):
    """Writes the file, and beside it the r, g, b, a that it stores, rounded to 8 bits."""
    rng = np.random.default_rng(kind * 100 + depth)
    most = 2 ** depth - 1
    samples = rng.integers(0, most + 1, (HEIGHT, WIDTH, SAMPLES[kind]))
    after, rgba = [], np.full((HEIGHT, WIDTH, 4), 255)
    if kind == PALETTE:
        colors = rng.integers(0, 256, (most + 1, 3))
        after.append((b"PLTE", colors.astype("u1").tobytes()))
        rgba[..., :3] = colors[samples[..., 0]]
        if transparent:  # the first entries; the others are opaque
            alphas = rng.integers(0, 256, most // 2 + 1)
            after.append((b"tRNS", alphas.astype("u1").tobytes()))
            rgba[..., 3] = np.concatenate([alphas, np.full(most + 1, 255)])[samples[..., 0]]
    else:
        eight = np.floor(samples * 255 / most + 0.5).astype(int)
        colors = SAMPLES[kind] - (kind in (GREY_ALPHA, RGBA))
        rgba[..., :3] = eight[..., :colors]
        if kind in (GREY_ALPHA, RGBA):
            rgba[..., 3] = eight[..., -1]
        elif transparent:
            key = samples[2, 3]
            after.append((b"tRNS", key.astype(">u2").tobytes()))
            rgba[..., 3] = np.where((samples == key).all(axis=-1), 0, 255)
    base = f"{folder}/{kind}-{depth}-{name}{'-key' if transparent else ''}{'-interlaced' if interlaced else ''}"
    with open(base + ".png", "wb") as file:
        file.write(png(samples, kind, depth, before, after, interlaced))
    np.save(base + ".png.npy", rgba)
    return base + ".png"


def grid(folder):
    for kind, depths in DEPTHS.items():
        space = b"GRAY" if kind in (GREY, GREY_ALPHA) else b"RGB "
        for depth in depths:
            for name, before in color_chunks(space).items():
                # Each chunk with whole bytes of each type, and each depth with the chunk that converts most.
                if depth != 8 and name not in ("plain", "gamma-linear", "icc"):
                    continue
                write_png(folder, kind, depth, name, before, False, 0)
            for transparent in (False, True) if kind in (GREY, RGB, PALETTE) else (False,):
                write_png(folder, kind, depth, "gamma-linear", color_chunks(space)["gamma-linear"], transparent, 1)
            if kind in (GREY, RGB, PALETTE):
                write_png(folder, kind, depth, "gamma-2.2", color_chunks(space)["gamma-2.2"], True, 0)
    names = sorted(n for n in os.listdir(folder) if n.endswith(".png"))
    for name in names:
        rgba = np.load(f"{folder}/{name}.npy")
        alpha = rgba[..., 3] / 255.0
        expected = f"{folder}/{name}.npz"
        np.savez(expected, render=np.floor(rgba[..., :3] * alpha[..., None] + 0.5) / 255.0, alpha=alpha)
        same(f"{folder}/{name}", expected)
    print(f"{len(names)} PNGs: the stored values")


def same(one, other):
    done = subprocess.run(["splat", "compare", one, other, "--min-db", "200"], capture_output=True, text=True, check=False)
    assert done.returncode == 0, (one, other, done.stdout + done.stderr)


def segment(marker, content):
    return b"\xff" + bytes([marker]) + struct.pack(">H", len(content) + 2) + content


def wrapped(folder, pictures):
    """The same picture with what other programs store beside it."""
    icc = profile(b"RGB ")
    count = 0
    for picture in pictures:
        with open(picture, "rb") as file:
            data = file.read()
        if data[:2] == b"\xff\xd8":
            profiles = segment(0xE2, b"ICC_PROFILE\0\1\1" + icc)
            parts = {"icc": profiles, "exif": segment(0xE1, b"Exif\0\0" + EXIF_TURNED),
                     "text": segment(0xE1, b"http://ns.adobe.com/xap/1.0/\0<x/>") + segment(0xFE, b"a comment")}
            parts["all"] = b"".join(parts.values())
            files = {f"{name}.jpg": data[:2] + part + data[2:] for name, part in parts.items()}
        else:
            body = data[12:]
            parts = {"icc": (0x20, [(b"ICCP", icc)], []), "exif": (0x08, [], [(b"EXIF", EXIF_TURNED)]),
                     "all": (0x28, [(b"ICCP", icc)], [(b"EXIF", EXIF_TURNED), (b"XMP ", b"<x/>  ")])}
            files = {}
            width, height = (v + 1 for v in struct.unpack("<2H", struct.pack("<I", (lambda b: (b & 0x3FFF) | (b >> 14 & 0x3FFF) << 16)
                                                                              (struct.unpack_from("<I", body, 9)[0]))))
            for name, (flags, before, after) in parts.items():
                extended = struct.pack("<I", flags) + struct.pack("<I", width - 1)[:3] + struct.pack("<I", height - 1)[:3]
                chunks = b"".join(k + struct.pack("<I", len(c)) + c for k, c in [(b"VP8X", extended), *before])
                chunks += body + b"".join(k + struct.pack("<I", len(c)) + c for k, c in after)
                files[f"{name}.webp"] = b"RIFF" + struct.pack("<I", len(chunks) + 4) + b"WEBP" + chunks
        for name, content in files.items():
            with open(f"{folder}/{name}", "wb") as file:
                file.write(content)
            same(f"{folder}/{name}", picture)
            count += 1
    print(f"{count} JPEG and WebP files: the stored values")


def peers(folder):
    """Compares the stored values with PIL's and OpenCV's, which truncate 16 bits where splat rounds them."""
    import cv2
    import PIL
    from PIL import Image
    counts = {"PIL": 0, "OpenCV": 0}
    for name in sorted(n for n in os.listdir(folder) if n.endswith(".png")):
        kind, depth, *_ = name.split("-")
        kind, depth = int(kind), int(depth)
        rgba = np.load(f"{folder}/{name}.npy")
        by = {}
        with Image.open(f"{folder}/{name}") as picture:
            if picture.mode == "I":  # grey of 16 bits
                by["PIL"] = np.floor(np.asarray(picture)[..., None].repeat(3, axis=2) / 257 + 0.5)
            else:
                # PIL does not scale a transparent colour of fewer than 8 bits as it does the pixels.
                has_alpha = depth == 8 or kind == PALETTE
                by["PIL"] = np.asarray(picture.convert("RGBA" if has_alpha else "RGB"))
        by["OpenCV"] = cv2.imread(f"{folder}/{name}", cv2.IMREAD_COLOR | cv2.IMREAD_IGNORE_ORIENTATION)[..., ::-1]
        for peer, values in by.items():
            difference = np.abs(values.astype(int) - rgba[..., :values.shape[-1]]).max()
            assert difference <= (1 if depth == 16 else 0), (name, peer, difference)
            counts[peer] += 1
    for peer, count in counts.items():
        version = {"PIL": PIL, "OpenCV": cv2}[peer].__version__
        print(f"peer {peer} {version}: {count} PNGs agree")


if __name__ == "__main__":
    match sys.argv[1]:
        case "grid":
            os.makedirs(sys.argv[2], exist_ok=True)
            grid(sys.argv[2])
        case "wrapped":
            os.makedirs(sys.argv[2], exist_ok=True)
            wrapped(sys.argv[2], sys.argv[3:])
        case "peers":
            peers(sys.argv[2])
