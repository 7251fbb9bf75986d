"""usage: two_scales.py SCENE.ply TWO.ply THREE.ply

Writes the Gaussians of a PLY of floats with two scales, and with a third that is too small to be seen.
"""

import array
import sys

data = open(sys.argv[1], "rb").read()
end = data.index(b"end_header\n") + len(b"end_header\n")
header = data[:end].decode()
names = [line.split()[-1] for line in header.splitlines() if line.startswith("property float ")]
values = array.array("f", data[end:])
third, count = names.index("scale_2"), len(names)
values[third::count] = array.array("f", [-80]) * (len(values) // count)
open(sys.argv[3], "wb").write(header.encode() + values.tobytes())
two = array.array("f", (v for i, v in enumerate(values) if i % count != third))
open(sys.argv[2], "wb").write(header.replace("property float scale_2\n", "").encode() + two.tobytes())
