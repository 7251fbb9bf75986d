"""Runs units on the first OpenCL device that there is: many units in a kernel."""

import re
import warnings

import numpy as np
import pyopencl as cl

from .units import SHARED

HEAD = """#pragma OPENCL EXTENSION cl_khr_fp16 : enable
kernel void values(global const char *in, constant char *constants, global char *out, local char *shared{images}) {{
  const uint i = get_global_id(0), lid = get_local_id(0);
"""
# What lies between two outputs, so that a store beside one is seen, and what it is filled with.
FENCE, FILL = 128, 0xa5


def placed(sizes):
    """Places of things in a row, each aligned and with a fence behind it; and the size of all."""
    places, end = [], FENCE
    for size in sizes:
        places.append(end)
        end += (size + 127) // 128 * 128 + FENCE
    return places, end


class Program:
    """A kernel of units that are launched alike."""

    def __init__(self, units):
        self.units = units
        inputs = {}
        for unit in units:
            for array in unit.inputs:
                inputs.setdefault(array.tobytes(), len(inputs))
        input_places, size = placed(map(len, inputs))
        self.input = np.zeros(size, np.uint8)
        for data, place in zip(inputs, input_places):
            self.input[place:place + len(data)] = np.frombuffer(data, np.uint8)
        output_places, self.output_size = placed(s for u in units for s in u.output_sizes)
        self.outputs, text = [], ""
        self.images = [image for unit in units for image in unit.images]
        for unit in units:
            mine = [output_places.pop(0) for _ in unit.output_sizes]
            self.outputs.append(mine)
            places = {f"$O{n}": place for n, place in enumerate(mine)}
            places.update((f"$I{n}", input_places[inputs[a.tobytes()]]) for n, a in enumerate(unit.inputs))
            places.update((f"$M{n}", f"image{self.images.index(image)}") for n, image in enumerate(unit.images))
            text += "  { " + re.sub(r"\$[IOM]\d+", lambda m: str(places[m[0]]), unit.text) + "}\n"
        images = "".join(f", {image.parameter} image{n}" for n, image in enumerate(self.images))
        self.text = HEAD.format(images=images) + text + "}\n"

    def results(self, found, texels):
        """The outputs of each unit, and the lines about what was written beside them. found: all outputs in memory, after a
        run; texels: those of images."""
        results = []
        for each, places in zip(self.units, self.outputs):
            lines = []
            for place, size in zip(places, each.output_sizes):
                beside = (found[place - FENCE:place], found[place + size:place + (size + 127) // 128 * 128 + FENCE])
                if any((b != FILL).any() for b in beside):
                    lines.append("wrote beside its output")
            outputs = [found[p:p + s].tobytes() for p, s in zip(places, each.output_sizes)]
            results.append((outputs + [texels[image] for image in each.images if image in texels], lines))
        return results


class Runner:
    """Something that can run a program of units: outputs() gives their outputs, or one of the errors."""

    errors = ()

    def run(self, units):
        """Lines for each unit. Units that cannot be compiled together are tried apart."""
        try:
            found = self.outputs(Program(units))
        except self.errors as error:
            if len(units) == 1:
                return [[f"does not run: {error}"]]
            middle = len(units) // 2
            return self.run(units[:middle]) + self.run(units[middle:])
        return [beside + unit.check(outputs) for unit, (outputs, beside) in zip(units, found)]


class Device(Runner):
    errors = (cl.RuntimeError, cl.LogicError, cl.Error)

    def __init__(self, options=()):
        platforms = cl.get_platforms()
        self.context = cl.Context([platforms[0].get_devices()[0]])
        self.queue = cl.CommandQueue(self.context)
        self.options = list(options)
        warnings.simplefilter("ignore", cl.CompilerWarning)

    def outputs(self, program):
        """The outputs of each unit, and the lines about what was written beside them."""
        flags = cl.mem_flags
        kernel = cl.Program(self.context, program.text).build(options=self.options + ["-w"]).values
        source = cl.Buffer(self.context, flags.READ_ONLY | flags.COPY_HOST_PTR, hostbuf=program.input)
        found = np.full(program.output_size, FILL, np.uint8)
        target = cl.Buffer(self.context, flags.READ_WRITE | flags.COPY_HOST_PTR, hostbuf=found)
        unit = program.units[0]
        images = [image.made(self.context) for image in program.images]
        kernel(self.queue, (unit.items,), (unit.group,), source, source, target, cl.LocalMemory(SHARED * unit.group),
               *images)
        cl.enqueue_copy(self.queue, found, target)
        texels = {image: image.read(self.queue, made) for image, made in zip(program.images, images) if image.written}
        return program.results(found, texels)
