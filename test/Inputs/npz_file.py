"""Arrays of floats of an .npz file, without numpy, which tests do not need."""

import io
import math
import struct
import zipfile


def array(data):
    """The shape and the numbers of what a .npy file holds; None if they are not fp32."""
    with io.BytesIO(data) as f:
        assert f.read(8) == b"\x93NUMPY\x01\x00"
        header = f.read(struct.unpack("<H", f.read(2))[0]).decode()
        if "'<f4'" not in header:
            return None
        shape = [int(n) for n in header.split("(")[1].split(")")[0].split(",") if n.strip()]
        return shape, struct.unpack(f"<{math.prod(shape)}f", f.read())


def arrays(path):
    """By name, the fp32 ones."""
    with zipfile.ZipFile(path) as archive:
        found = {name.removesuffix(".npy"): array(archive.read(name)) for name in archive.namelist()}
    return {name: held for name, held in found.items() if held}
