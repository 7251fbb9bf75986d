"""Writes small files that claim or unpack to gigabytes, and reads each with splat: it must refuse each with one line and
exit code 3, in little memory. usage: bombs.py FOLDER"""
import os
import struct
import subprocess
import sys
import zipfile
import zlib

folder = sys.argv[1]
MOST_KIB = 160 << 10  # of memory: twice what JSON may have, and what splat itself takes
LONG = 300 << 20  # bytes that a bomb unpacks to


class Zeros:
    """LONG bytes behind \\p start, deflated once and repeated."""

    def __init__(self, start=b"", fill=b"\0"):
        part = fill * (1 << 20)
        packer = zlib.compressobj(9, zlib.DEFLATED, -15)
        head = packer.compress(start) + packer.flush(zlib.Z_FULL_FLUSH)
        middle = packer.compress(part) + packer.flush(zlib.Z_FULL_FLUSH)
        again = packer.compress(part) + packer.flush(zlib.Z_FULL_FLUSH)
        count = LONG >> 20
        self.packed = head + middle + again * (count - 1) + packer.flush()
        self.size = len(start) + (count << 20)
        self.crc = zlib.crc32(start)
        for _ in range(count):
            self.crc = zlib.crc32(part, self.crc)


def archive(name, bombs, whole=(), claimed=None):
    """A zip archive with \\p bombs, whose directory says \\p claimed of their size."""
    path = os.path.join(folder, name)
    directory = b""
    with open(path, "wb") as out:
        for entry, bomb in bombs.items():
            size = bomb.size if claimed is None else claimed
            fields = struct.pack("<HHHHHIIIHH", 20, 0, 8, 0, 33, bomb.crc, len(bomb.packed), size, len(entry), 0)
            at = out.tell()
            out.write(b"PK\3\4" + fields + entry.encode() + bomb.packed)
            directory += b"PK\1\2" + struct.pack("<H", 20) + fields + struct.pack("<HHHII", 0, 0, 0, 0, at) + entry.encode()
        at = out.tell()
        out.write(directory + b"PK\5\6" + struct.pack("<HHHHIIH", 0, 0, len(bombs), len(bombs), len(directory), at, 0))
    with zipfile.ZipFile(path, "a") as more:
        for entry, content in whole:
            more.writestr(entry, content)


def npy(shape, kind="<f8"):
    header = f"{{'descr': '{kind}', 'fortran_order': False, 'shape': {shape}, }}\n".encode()
    return b"\x93NUMPY\1\0" + struct.pack("<H", len(header)) + header


def attribute(name, kind, value, size=None):
    return name + b"\0" + kind + b"\0" + struct.pack("<i", len(value) if size is None else size) + value


def header(width, height, *more, channels=1):
    window = struct.pack("<4i", 0, 0, width - 1, height - 1)
    names = b"".join(b"%s\0" % name + struct.pack("<iiii", 2, 0, 1, 1)
                     for name in [b"Y", *(b"c%d" % i for i in range(channels - 1))])
    return b"".join([attribute(b"channels", b"chlist", names + b"\0"), attribute(b"compression", b"compression", b"\0"),
                     attribute(b"dataWindow", b"box2i", window), attribute(b"displayWindow", b"box2i", window),
                     attribute(b"lineOrder", b"lineOrder", b"\0"),
                     attribute(b"pixelAspectRatio", b"float", struct.pack("<f", 1)),
                     attribute(b"screenWindowCenter", b"v2f", bytes(8)),
                     attribute(b"screenWindowWidth", b"float", struct.pack("<f", 1)), *more]) + b"\0"


def exr(*headers, flags=0):
    return struct.pack("<ii", 20000630, 2 | flags) + b"".join(headers) + bytes(64)


def write(name, content):
    with open(os.path.join(folder, name), "wb") as out:
        out.write(content)


def zeros(megabytes):
    """Packed piece by piece: the kernel counts the memory of this process in the peak of each that it starts."""
    packer = zlib.compressobj()
    return b"".join(packer.compress(bytes(1 << 20)) for _ in range(megabytes)) + packer.flush()


def chunk(kind, content):
    return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))


meta = b"""{"version": 2, "count": 9, "means": {"mins": [0, 0, 0], "maxs": [1, 1, 1], "files": ["l.webp", "u.webp"]},
 "quats": {"files": ["q.webp"]}, "scales": {"files": ["s.webp"]}, "sh0": {"files": ["c.webp"]}}"""
archive("meta.sog", {"meta.json": Zeros(b"{", b" ")})
archive("meta_lies.sog", {"meta.json": Zeros(b"{", b" ")}, claimed=10)
archive("plane.sog", {"l.webp": Zeros(b"RIFF")}, [("meta.json", meta)])
archive("plane_of_many.sog", {"l.webp": Zeros(b"RIFF")}, [("meta.json", meta.replace(b'"count": 9', b'"count": 268435456'))])
archive("no_header.npz", {"render.npy": Zeros()})
archive("flat.npz", {"render.npy": Zeros(npy(f"({LONG // 8},)"))})
archive("lies.npz", {"render.npy": Zeros(npy("(2, 2, 3)"))}, claimed=48 + len(npy("(2, 2, 3)")))
archive("header.npz", {"render.npy": Zeros(b"\x93NUMPY\2\0" + struct.pack("<I", LONG), b" ")})
archive("alpha.npz", {"alpha.npy": Zeros(npy("(2, 2)", f"<U{LONG // 16}"))}, [("render.npy", npy("(2, 2, 3)") + bytes(96))])
archive("beside.npz", {"other.npy": Zeros(npy(f"({LONG // 8},)"))}, [("render.npy", npy("(2, 2, 3)") + bytes(96))])

write("attribute.exr", exr(attribute(b"aa", b"string", b"", 0x7fffffff))[:-64])
write("unknown.exr", exr(attribute(b"aa", b"what", b"", 0x7ffffff0)))
write("negative.exr", exr(attribute(b"aa", b"what", b"", -1)))
write("preview.exr", exr(header(4, 4, attribute(b"preview", b"preview", struct.pack("<II", 30000, 30000)))))
write("rows.exr", exr(header(1, 1 << 29)))
write("columns.exr", exr(header(1 << 29, 1)))
write("tiles.exr", exr(header(30000, 30000, attribute(b"tiles", b"tiledesc", struct.pack("<IIB", 1, 1, 0))), flags=0x200))
write("small_tiles.exr", exr(header(512, 512, attribute(b"tiles", b"tiledesc", struct.pack("<IIB", 1, 1, 2))), flags=0x200))
write("channels.exr", exr(header(500, 500, channels=4000)))
parts = [header(4, h, attribute(b"type", b"string", b"scanlineimage"), attribute(b"name", b"string", n),
                attribute(b"chunkCount", b"int", struct.pack("<i", 0x7fffffff)))
         for h, n in ((4, b"a"), (1 << 29, b"b"))]
write("part.exr", exr(*parts, b"\0", flags=0x1000))
write("parts.exr", exr(parts[0], b"\0", flags=0x1000))

write("side.png", b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 16384, 16384, 8, 6, 0, 0, 0)) +
      chunk(b"IDAT", zlib.compress(bytes(1 << 16))) + chunk(b"IEND", b""))
write("text.png", b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 4, 4, 8, 6, 0, 0, 0)) +
      chunk(b"iCCP", b"a\0\0" + zeros(200)) + chunk(b"zTXt", b"a\0\0" + zeros(200)) +
      chunk(b"IDAT", zlib.compress(bytes(4))) + chunk(b"IEND", b""))
sides = struct.pack("<BI", 0x2f, 16383 | 16383 << 14)
write("side.webp", b"RIFF" + struct.pack("<I", 4 + 8 + 6) + b"WEBPVP8L" + struct.pack("<I", 5) + sides + b"\0")
frame = b"\xff\xc2" + struct.pack(">HBHHB", 17, 8, 16384, 16384, 3) + bytes([1, 17, 0, 2, 17, 0, 3, 17, 0])
write("side.jpg", b"\xff\xd8" + frame + b"\xff\xd9")
write("side.pfm", b"PF\n32768 32768\n-1\n" + bytes(12))

# A window of 2^27 bytes; one of 2^31.
for name, exponent in (("window.spz", 17), ("larger_window.spz", 21)):
    zstd = b"\x28\xb5\x2f\xfd" + bytes([0, exponent << 3]) + b"\1\0\0"
    table = b"".join(struct.pack("<QQ", len(zstd), size << 20) for size in (9, 1, 3, 3, 4))
    write(name, struct.pack("<4sIIBBBBI", b"NGSP", 4, 1 << 20, 0, 12, 0, 5, 32) + bytes(12) + table + zstd * 5)
text = b'{"asset": {"version": "2.0"}, "buffers": [{"byteLength": 4000000000}], "scene": 0}'
write("buffer.glb", b"glTF" + struct.pack("<III", 2, 4000000000, len(text)) + b"JSON" + text +
      struct.pack("<I", 3900000000) + b"BIN\0")
write("rows.ply", b"ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\n" +
      b"".join(b"property float %s\n" % name for name in (
          b"x", b"y", b"z", b"f_dc_0", b"f_dc_1", b"f_dc_2", b"opacity", b"scale_0", b"scale_1", b"scale_2", b"rot_0",
          b"rot_1", b"rot_2", b"rot_3")) + b"end_header\n")

whole = 0
for name in sorted(os.listdir(folder)):
    path = os.path.join(folder, name)
    command = ["splat", "compare", path, path]
    if os.path.splitext(name)[1] in (".sog", ".spz", ".glb", ".ply"):
        command = ["splat", "info", path]
    with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) as process:
        said = process.stderr.read()
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    is_right = process.returncode == (0 if name == "beside.npz" else 3) and said.count("\n") <= 1
    print(f"{name}: {os.path.getsize(path)} bytes, {process.returncode}, {usage.ru_maxrss >> 10} MiB: {said.strip()}")
    whole += is_right and usage.ru_maxrss < MOST_KIB
print(f"{whole} of {len(os.listdir(folder))} in little memory")
