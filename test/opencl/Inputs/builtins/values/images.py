"""Image functions: each texel of a small image is read or written, and what the image is.

Formats, samplers and what lies outside are tested elsewhere (ImageFormats_test.cpp, Samplers_test.cpp,
ImageTypes_test.cpp).
"""

import random
import re

import numpy as np
import pyopencl as cl

from .columns import stored
from .formats import TYPES, Vector
from .units import Unit, compared, load, store

TEXELS = 24
CHANNELS = cl.channel_type
# PyOpenCL has no name for CL_DEPTH.
RGBA, DEPTH = cl.channel_order.RGBA, 0x10bd
# By the end of a function's name: the type of its elements, and the channels that it can be used with.
ELEMENTS = {"f": ("float", CHANNELS.FLOAT), "h": ("half", CHANNELS.HALF_FLOAT), "i": ("int", CHANNELS.SIGNED_INT32),
            "ui": ("uint", CHANNELS.UNSIGNED_INT32)}
# By the type without "image" and "_t": width, height, depth; the last is the number of layers if it is an array.
# PyOpenCL makes no arrays of 1D images.
SHAPES = {"1d": (24,), "1d_buffer": (24,), "2d": (6, 4), "2d_array": (3, 4, 2), "3d": (3, 4, 2),
          "2d_depth": (6, 4), "2d_array_depth": (3, 4, 2)}
PARAMETER = re.compile(r"(read_only|write_only|read_write) image(\w+)_t")
SAMPLER = "CLK_NORMALIZED_COORDS_FALSE | CLK_ADDRESS_CLAMP_TO_EDGE | CLK_FILTER_NEAREST"


class Image:
    """An image that a unit has as a parameter of its kernel."""

    def __init__(self, parameter, channels, kind, column):
        self.parameter, self.kind = parameter, kind
        self.access, self.shape_name = PARAMETER.fullmatch(parameter).groups()
        self.shape = SHAPES[self.shape_name]
        self.order = DEPTH if "depth" in self.shape_name else RGBA
        self.channels, self.column = channels, column
        self.written = self.access != "read_only"
        self.buffer = None

    def made(self, context):
        flags = cl.mem_flags.READ_WRITE | cl.mem_flags.COPY_HOST_PTR
        form = cl.ImageFormat(self.order, self.channels)
        texels = stored(self.column, self.kind)
        if "buffer" in self.shape_name:
            self.buffer = cl.Buffer(context, flags, hostbuf=texels)
            return cl.Image(context, cl.mem_flags.READ_WRITE, form, shape=self.shape, buffer=self.buffer)
        return cl.Image(context, flags, form, shape=self.shape, hostbuf=texels, is_array="array" in self.shape_name)

    def read(self, queue, image):
        """What is in it. An image of a buffer is its memory."""
        texels = np.empty(len(self.column), self.kind.storage)
        if self.buffer:
            cl.enqueue_copy(queue, texels, self.buffer)
            return texels.tobytes()
        # PyOpenCL copies images of few types.
        region = self.shape + (1,) * (3 - len(self.shape))
        mapped, _, pitch, _ = cl.enqueue_map_image(queue, image, cl.map_flags.READ, (0, 0, 0), region, texels.shape, texels.dtype)
        row = texels.nbytes // TEXELS * self.shape[0]
        if pitch != row:
            raise ValueError(f"rows of {row} bytes are {pitch} bytes apart")
        texels[:] = mapped
        mapped.base.release(queue)
        return texels.tobytes()


def coordinates(kind, image, number):
    """The coordinates of a texel as a text of a coordinate's type."""
    parts, divisor = [], 1
    for n, size in enumerate(image.shape):
        layer = "array" in image.shape_name and n == len(image.shape) - 1
        # The middle of a texel; a layer has none.
        parts.append(f"{number} / {divisor} % {size}" + (" + 0.5f" if kind.element.real and not layer else ""))
        divisor *= size
    return f"({kind.name})({', '.join(parts + ['0'] * (kind.width - len(parts)))})"


def texels_of(kind, width, name):
    source = random.Random(name)
    if kind.real:
        return [source.randint(-500, 500) / 4 for _ in range(TEXELS * width)]
    return [source.randint(kind.least, kind.most) for _ in range(TEXELS * width)]


# Of the work-item's own, so that texels are not read in their order.
NUMBER = "((i * 7 + 3) % 24)"


def access(overload, verb, end):
    image_parameter = overload.parameters[0]
    element, channels = ELEMENTS[end]
    value = Vector(overload.result if verb == "read" else overload.parameters[-1])
    kind = TYPES[element]
    column = texels_of(kind, value.width, overload.name)
    image = Image(image_parameter, channels, kind, column if verb == "read" else [0] * len(column))
    sampled = "sampler_t" in overload.parameters
    at = coordinates(Vector(overload.parameters[2 if sampled else 1]), image, NUMBER)
    chosen = [n for i in range(TEXELS) for n in range((i * 7 + 3) % 24 * value.width, ((i * 7 + 3) % 24 + 1) * value.width)]

    if verb == "read":
        sampler = f"const sampler_t s = {SAMPLER}; " if sampled else ""
        text = f"{sampler}{value.name} r = {overload.name}($M0, {'s, ' if sampled else ''}{at}); " + store(value, "$O0", "r")
        wanted = [column[n] for n in chosen]
        made = Unit(overload, TEXELS, 12, [], [len(column) * kind.storage.itemsize], text,
                    lambda found: compared(found[0], kind, wanted, lambda k: (f"work-item {k // value.width}",)))
    else:
        text = f"{overload.name}($M0, {at}, {load(value, '$I0')}); "
        wanted = [0] * len(column)
        for k, n in enumerate(chosen):
            wanted[n] = column[k]
        made = Unit(overload, TEXELS, 12, [stored(column, kind)], [], text,
                    lambda found: compared(found[0], kind, wanted, lambda k: (f"texel {k // value.width}",)))
    made.images = [image]
    return made


QUESTIONS = {
    "width": lambda image: image.shape[0], "height": lambda image: image.shape[1], "depth": lambda image: image.shape[2],
    "array_size": lambda image: image.shape[-1], "channel_order": lambda image: image.order,
    "channel_data_type": lambda image: image.channels,
}


def question(overload, what):
    kind = TYPES["float"]
    width = 1 if "depth" in overload.parameters[0] else 4
    image = Image(overload.parameters[0], CHANNELS.FLOAT, kind, [0.0] * TEXELS * width)
    image.written = False
    result = Vector(overload.result)
    text = f"{result.name} r = {overload.name}($M0); " + store(result, "$O0", "r")
    answer = (list(image.shape) + [0])[:result.width] if what == "dim" else [QUESTIONS[what](image)]
    made = Unit(overload, TEXELS, 12, [], [TEXELS * result.width * 4], text,
                lambda found: compared(found[0], result.element, answer * TEXELS, lambda k: (f"work-item {k}",)))
    made.images = [image]
    return made


def unit(overload):
    if not overload.parameters or "image1d_array_t" in overload.parameters[0]:
        return None
    used = re.fullmatch(r"(read|write)_image(f|h|i|ui)", overload.name)
    asked = re.fullmatch(r"get_image_(\w+)", overload.name)
    if used:
        return access(overload, *used.groups())
    return question(overload, asked[1]) if asked else None
