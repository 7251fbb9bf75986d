#!/usr/bin/env python3
"""Draws glTF models with Mesa's llvmpipe beside `splat render --mesh` (docs/meshes.md).

usage: mesa_meshes.py [--size WxH] [--light X,Y,Z] [--path raster|simt] [--keep FOLDER] MODEL.glb...
Each model is looked at from the front and above. This program reads the glTF itself: nodes, triangles, base colours,
vertex colours, normals, PNG textures with their samplers; OpenGL ES makes the mip-maps. The rules of colour are those
of docs/meshes.md: filtering and light in linear light, encoded as sRGB. Printed for each model: the pixels that either
draws, the share of them that both draw, and over these the mean and the largest difference of a channel.
Needs libegl1, libgles2 and libgl1-mesa-dri; nothing is drawn on a screen. Exit codes: 0 done, 2 usage, 3 a model that
this program does not read.
"""

import argparse
import ctypes
import json
import math
import os
import struct
import subprocess
import sys
import tempfile
import zlib

import numpy

os.environ["LIBGL_ALWAYS_SOFTWARE"] = "1"
os.environ["GALLIUM_DRIVER"] = "llvmpipe"

AMBIENT = 0.2
VERTEX = """#version 300 es
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 color;  // as pictures show it
layout(location = 2) in vec2 coordinate;
layout(location = 3) in vec3 normal;
uniform mat4 to_clip;
out vec3 own; out vec2 at; out vec3 up; out vec3 place;
void main() { gl_Position = to_clip * vec4(position, 1); own = color; at = coordinate; up = normal; place = position; }
"""
FRAGMENT = """#version 300 es
precision highp float;
in vec3 own; in vec2 at; in vec3 up; in vec3 place;
uniform sampler2D picture;
uniform bool textured, lit;
uniform vec3 light, eye;
out vec4 result;
vec3 to_linear(vec3 c) { return mix(pow((c + 0.055) / 1.055, vec3(2.4)), c / 12.92, lessThanEqual(c, vec3(0.04045))); }
vec3 from_linear(vec3 c) {
  return mix(1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, 12.92 * c, lessThanEqual(c, vec3(0.0031308)));
}
void main() {
  vec3 color = to_linear(own);
  if (textured) color *= texture(picture, at).rgb;
  if (lit) {
    vec3 n = normalize(up);
    if (dot(n, place - eye) > 0.0) n = -n;
    color *= AMBIENT + (1.0 - AMBIENT) * max(-dot(n, light), 0.0);
  }
  result = vec4(from_linear(color), 1);
}
""".replace("AMBIENT", str(AMBIENT))


class Unread(Exception):
    """Why a model is not read."""


def png(data):
    """The picture of 8 bits a channel as rows of r, g, b, a."""
    at, idat, palette, clear = 8, b"", None, b""
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + size]
        if kind == b"IHDR":
            width, height, bits, colour, _, _, interlaced = struct.unpack(">IIBBBBB", body)
        elif kind == b"PLTE":
            palette = numpy.frombuffer(body, numpy.uint8).reshape(-1, 3)
        elif kind == b"tRNS":
            clear = body
        elif kind == b"IDAT":
            idat += body
        at += 12 + size
    if bits != 8 or interlaced:
        raise Unread("a PNG that is interlaced or not of 8 bits")
    channels = {0: 1, 2: 3, 3: 1, 4: 2, 6: 4}[colour]
    raw = numpy.frombuffer(zlib.decompress(idat), numpy.uint8).reshape(height, 1 + width * channels)
    rows = numpy.zeros((height + 1, width * channels), numpy.uint8)
    for y in range(height):
        line = raw[y, 1:].astype(int)
        above = rows[y].astype(int)
        kind = raw[y, 0]
        if kind == 0:
            out = line
        elif kind == 2:
            out = line + above
        else:
            out = numpy.zeros_like(line)
            for x in range(len(line)):
                left = out[x - channels] if x >= channels else 0
                corner = above[x - channels] if x >= channels else 0
                if kind == 1:
                    guess = left
                elif kind == 3:
                    guess = (left + above[x]) // 2
                else:
                    p = left + above[x] - corner
                    guess = min((left, above[x], corner), key=lambda v: abs(p - v))
                out[x] = (line[x] + guess) & 255
        rows[y + 1] = out & 255
    found = rows[1:].reshape(height, width, channels)
    if colour == 3:
        found = palette[found[..., 0]]
    rgba = numpy.full((height, width, 4), 255, numpy.uint8)
    if colour in (0, 4):
        rgba[..., :3] = found[..., :1]
    else:
        rgba[..., :3] = found[..., :3]
    if found.shape[2] in (2, 4):
        rgba[..., 3] = found[..., -1]
    if clear and colour != 3:
        raise Unread("a PNG with a transparent colour")
    return rgba


class Model:
    """The triangles of a .glb, in lists for OpenGL."""

    TYPES = {5121: numpy.uint8, 5123: numpy.uint16, 5125: numpy.uint32, 5126: numpy.float32}
    WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}

    def __init__(self, path):
        with open(path, "rb") as file:
            data = file.read()
        if data[:4] != b"glTF":
            raise Unread("no .glb")
        size = struct.unpack("<I", data[12:16])[0]
        self.json = json.loads(data[20:20 + size])
        self.binary = data[28 + size:]
        self.parts = []  # (arrays of vertices, triangles, texture or None)
        scene = self.json["scenes"][self.json.get("scene", 0)]
        for node in scene["nodes"]:
            self._walk(node, numpy.eye(4))

    def view(self, index):
        view = self.json["bufferViews"][index]
        return self.binary[view.get("byteOffset", 0):][:view["byteLength"]], view.get("byteStride", 0)

    def accessor(self, index):
        a = self.json["accessors"][index]
        kind, width = self.TYPES[a["componentType"]], self.WIDTHS[a["type"]]
        data, stride = self.view(a["bufferView"])
        each = numpy.dtype(kind).itemsize * width
        rows = numpy.lib.stride_tricks.as_strided(
            numpy.frombuffer(data, numpy.uint8)[a.get("byteOffset", 0):], (a["count"], each), (stride or each, 1))
        values = numpy.ascontiguousarray(rows).view(kind).reshape(a["count"], width)
        if a.get("normalized"):
            values = values / float(numpy.iinfo(kind).max)
        return values

    def _walk(self, index, above):
        node = self.json["nodes"][index]
        here = above @ self._local(node)
        if "mesh" in node:
            for primitive in self.json["meshes"][node["mesh"]]["primitives"]:
                self._primitive(primitive, here)
        for child in node.get("children", []):
            self._walk(child, here)

    @staticmethod
    def _local(node):
        if "matrix" in node:
            return numpy.array(node["matrix"], float).reshape(4, 4).T
        x, y, z, w = node.get("rotation", [0, 0, 0, 1])
        m = numpy.eye(4)
        m[:3, :3] = numpy.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                                 [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                                 [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])
        m[:3, :3] *= node.get("scale", [1, 1, 1])
        m[:3, 3] = node.get("translation", [0, 0, 0])
        return m

    def _primitive(self, p, to_world):
        if p.get("mode", 4) != 4:
            raise Unread("triangles in strips")
        attributes = p["attributes"]
        position = self.accessor(attributes["POSITION"]) @ to_world[:3, :3].T + to_world[:3, 3]
        count = len(position)
        material = self.json["materials"][p["material"]] if "material" in p else {}
        if material.get("alphaMode", "OPAQUE") != "OPAQUE":
            raise Unread("alphaMode " + material["alphaMode"])
        pbr = material.get("pbrMetallicRoughness", {})
        color = numpy.tile(pbr.get("baseColorFactor", [1, 1, 1, 1])[:3], (count, 1)).astype(float)
        if "COLOR_0" in attributes:
            color *= self.accessor(attributes["COLOR_0"])[:, :3]
        color = numpy.where(color <= 0.0031308, 12.92 * color, 1.055 * color ** (1 / 2.4) - 0.055)
        texture = None
        coordinate = numpy.zeros((count, 2))
        if "baseColorTexture" in pbr:
            use = pbr["baseColorTexture"]
            coordinate = self.accessor(attributes[f"TEXCOORD_{use.get('texCoord', 0)}"])
            texture = self._texture(use["index"])
        normal = numpy.zeros((count, 3))
        if "NORMAL" in attributes:
            normal = self.accessor(attributes["NORMAL"]) @ numpy.linalg.inv(to_world[:3, :3])
        triangles = self.accessor(p["indices"]).reshape(-1) if "indices" in p else numpy.arange(count)
        rows = numpy.hstack([position, color, coordinate, normal]).astype(numpy.float32)
        self.parts.append((rows, triangles.astype(numpy.uint32), texture))

    def _texture(self, index):
        t = self.json["textures"][index]
        image = self.json["images"][t["source"]]
        data = self.view(image["bufferView"])[0]
        if data[:4] != b"\x89PNG":
            raise Unread("a texture that is no PNG")
        return png(data), self.json["samplers"][t["sampler"]] if "sampler" in t else {}


class Gl:
    """OpenGL ES 3 on llvmpipe, without a window."""

    def __init__(self):
        egl = ctypes.CDLL("libEGL.so.1")
        pointer = ctypes.c_void_p
        for name in ("eglGetPlatformDisplay", "eglCreateContext"):
            getattr(egl, name).restype = pointer
        display = pointer(egl.eglGetPlatformDisplay(0x31DD, None, None))  # surfaceless
        if not egl.eglInitialize(display, None, None):
            raise SystemExit("mesa_meshes.py: no EGL without a surface")
        egl.eglBindAPI(0x30A0)
        config, found = pointer(), ctypes.c_int()
        wanted = (ctypes.c_int * 5)(0x3040, 0x40, 0x3033, 0, 0x3038)  # ES 3, any surface
        egl.eglChooseConfig(display, wanted, ctypes.byref(config), 1, ctypes.byref(found))
        context = pointer(egl.eglCreateContext(display, config, None, (ctypes.c_int * 3)(0x3098, 3, 0x3038)))
        if not egl.eglMakeCurrent(display, None, None, context):
            raise SystemExit("mesa_meshes.py: no context of OpenGL ES 3")
        self.gl = ctypes.CDLL("libGLESv2.so.2")
        self.gl.glGetString.restype = ctypes.c_char_p
        self.name = self.gl.glGetString(0x1F01).decode() + ", " + self.gl.glGetString(0x1F02).decode()
        self.program = self._program()

    def _program(self):
        gl = self.gl
        program = gl.glCreateProgram()
        for kind, text in ((0x8B31, VERTEX), (0x8B30, FRAGMENT)):
            shader = gl.glCreateShader(kind)
            gl.glShaderSource(shader, 1, ctypes.byref(ctypes.c_char_p(text.encode())), None)
            gl.glCompileShader(shader)
            gl.glAttachShader(program, shader)
        gl.glLinkProgram(program)
        good = ctypes.c_int()
        gl.glGetProgramiv(program, 0x8B82, ctypes.byref(good))
        if not good.value:
            log = ctypes.create_string_buffer(4000)
            gl.glGetProgramInfoLog(program, 4000, None, log)
            raise SystemExit("mesa_meshes.py: " + log.value.decode())
        gl.glUseProgram(program)
        return program

    def _at(self, name):
        return self.gl.glGetUniformLocation(self.program, name.encode())

    def draw(self, model, camera, near, far, light):
        """r, g, b, coverage of each pixel, rows from the top."""
        gl = self.gl
        width, height = camera["width"], camera["height"]
        names = (ctypes.c_uint * 2)()
        gl.glGenRenderbuffers(2, names)
        frame = ctypes.c_uint()
        gl.glGenFramebuffers(1, ctypes.byref(frame))
        gl.glBindFramebuffer(0x8D40, frame)
        for name, form, point in ((names[0], 0x8814, 0x8CE0), (names[1], 0x8CAC, 0x8D00)):  # RGBA32F, depth 32F
            gl.glBindRenderbuffer(0x8D41, name)
            gl.glRenderbufferStorage(0x8D41, form, width, height)
            gl.glFramebufferRenderbuffer(0x8D40, point, 0x8D41, name)
        if gl.glCheckFramebufferStatus(0x8D40) != 0x8CD5:
            raise SystemExit("mesa_meshes.py: no framebuffer of floats")
        gl.glViewport(0, 0, width, height)
        gl.glEnable(0x0B71)  # depth test
        gl.glClearColor(*[ctypes.c_float(0)] * 4)
        gl.glClear(0x4100)
        rotation = numpy.array(camera["rotation"], float).T  # world to camera
        view = numpy.eye(4)
        view[:3, :3] = rotation
        view[:3, 3] = -rotation @ camera["position"]
        fx, fy = camera["fx"], camera["fy"]
        # y is down in the camera, and up in OpenGL.
        lens = numpy.array([[2 * fx / width, 0, 0, 0], [0, -2 * fy / height, 0, 0],
                            [0, 0, (far + near) / (far - near), -2 * far * near / (far - near)], [0, 0, 1, 0]])
        matrix = (lens @ view).astype(numpy.float32)
        gl.glUniformMatrix4fv(self._at("to_clip"), 1, 1, matrix.ctypes.data_as(ctypes.c_void_p))
        eye = numpy.array(camera["position"], numpy.float32)
        gl.glUniform3fv(self._at("eye"), 1, eye.ctypes.data_as(ctypes.c_void_p))
        gl.glUniform1i(self._at("lit"), light is not None)
        if light is not None:
            along = (numpy.array(light) / numpy.linalg.norm(light)).astype(numpy.float32)
            gl.glUniform3fv(self._at("light"), 1, along.ctypes.data_as(ctypes.c_void_p))
        for rows, triangles, texture in model.parts:
            self._part(rows, triangles, texture)
        out = numpy.zeros((height, width, 4), numpy.float32)
        gl.glReadPixels(0, 0, width, height, 0x1908, 0x1406, out.ctypes.data_as(ctypes.c_void_p))
        if gl.glGetError():
            raise SystemExit("mesa_meshes.py: an error of OpenGL")
        return out[::-1]

    def _part(self, rows, triangles, texture):
        gl = self.gl
        buffers = (ctypes.c_uint * 2)()
        gl.glGenBuffers(2, buffers)
        for target, name, data in ((0x8892, buffers[0], rows), (0x8893, buffers[1], triangles)):
            gl.glBindBuffer(target, name)
            gl.glBufferData(target, ctypes.c_ssize_t(data.nbytes), data.ctypes.data_as(ctypes.c_void_p), 0x88E4)
        for place, (width, offset) in enumerate(((3, 0), (3, 3), (2, 6), (3, 8))):
            gl.glEnableVertexAttribArray(place)
            gl.glVertexAttribPointer(place, width, 0x1406, 0, rows.shape[1] * 4, ctypes.c_void_p(4 * offset))
        gl.glUniform1i(self._at("textured"), texture is not None)
        if texture is not None:
            picture, sampler = texture
            name = ctypes.c_uint()
            gl.glGenTextures(1, ctypes.byref(name))
            gl.glBindTexture(0x0DE1, name)
            data = numpy.ascontiguousarray(picture)
            gl.glTexImage2D(0x0DE1, 0, 0x8C43, data.shape[1], data.shape[0], 0, 0x1908, 0x1401,
                            data.ctypes.data_as(ctypes.c_void_p))  # SRGB8_ALPHA8
            gl.glGenerateMipmap(0x0DE1)
            for key, value in ((0x2801, sampler.get("minFilter", 9987)), (0x2800, sampler.get("magFilter", 9729)),
                               (0x2802, sampler.get("wrapS", 10497)), (0x2803, sampler.get("wrapT", 10497))):
                gl.glTexParameteri(0x0DE1, key, value)
        gl.glDrawElements(4, len(triangles), 0x1405, None)


def camera_for(model, width, height):
    """In front of the model and above, so that it fills the picture."""
    points = numpy.vstack([rows[:, :3] for rows, _, _ in model.parts]).astype(float)
    low, high = points.min(0), points.max(0)
    middle, radius = (low + high) / 2, numpy.linalg.norm(high - low) / 2
    focal = 1.2 * height
    ahead = -numpy.array([0.5, 0.45, 0.9])
    ahead /= numpy.linalg.norm(ahead)
    right = numpy.cross(ahead, [0, 1, 0])
    right /= numpy.linalg.norm(right)
    down = numpy.cross(ahead, right)
    distance = 1.05 * radius * math.hypot(1, 2 * focal / height)
    return {"id": 0, "img_name": "front", "width": width, "height": height,
            "position": list(middle - distance * ahead),
            "rotation": numpy.array([right, down, ahead]).T.tolist(), "fx": focal, "fy": focal}, distance, radius


def far_scene(path, behind):
    """A scene of one Gaussian that no pixel shows."""
    names = ["x", "y", "z", "f_dc_0", "f_dc_1", "f_dc_2", "opacity", "scale_0", "scale_1", "scale_2", "rot_0", "rot_1",
             "rot_2", "rot_3"]
    head = "ply\nformat binary_little_endian 1.0\nelement vertex 1\n"
    head += "".join(f"property float {name}\n" for name in names) + "end_header\n"
    with open(path, "wb") as file:
        file.write(head.encode() + struct.pack("<14f", *behind, 0, 0, 0, 0, -9, -9, -9, 1, 0, 0, 0))


def compare(gl, path, options, folder):
    model = Model(path)
    width, height = options.size
    camera, distance, radius = camera_for(model, width, height)
    ours, name = os.path.join(folder, "ours.npz"), os.path.splitext(os.path.basename(path))[0]
    cameras, scene = os.path.join(folder, "cameras.json"), os.path.join(folder, "far.ply")
    with open(cameras, "w", encoding="utf-8") as file:
        json.dump([camera], file)
    rotation = numpy.array(camera["rotation"])
    far_scene(scene, numpy.array(camera["position"]) - 100 * distance * rotation[:, 2])
    near = distance / 1000
    light = ["--light=" + ",".join(map(str, options.light))] if options.light else []
    subprocess.run(["splat", "render", scene, "--cameras", cameras, "--mesh", path, "--near", str(near), "-o", ours,
                    "--path", options.path, *light], check=True, stdout=subprocess.DEVNULL)
    with numpy.load(ours) as found:
        render, alpha = found["render"], found["alpha"]
    theirs = gl.draw(model, camera, near, distance + 2 * radius, options.light)
    here, there = alpha > 0.5, theirs[..., 3] > 0.5
    both, either = here & there, here | there
    difference = numpy.abs(render - theirs[..., :3])[both]
    print(f"{name}: {sum(len(t) for _, t, _ in model.parts) // 3} triangles, {either.sum()} pixels, "
          f"{100 * both.sum() / either.sum():.4f} % drawn by both, {(here & ~there).sum()} by us alone, "
          f"{(there & ~here).sum()} by Mesa alone; difference {difference.mean():.2e} at a mean, "
          f"{difference.max():.4f} at most, {100 * (difference.max(1) > 2 / 255).mean():.3f} % of pixels above 2/255",
          flush=True)
    if options.keep:
        numpy.savez(os.path.join(options.keep, name + ".mesa.npz"), render=theirs[..., :3], alpha=theirs[..., 3])
        numpy.savez(os.path.join(options.keep, name + ".vorion.npz"), render=render, alpha=alpha)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("models", nargs="+", metavar="MODEL.glb")
    parser.add_argument("--size", default="640x480", type=lambda text: tuple(map(int, text.split("x"))))
    parser.add_argument("--light", type=lambda text: tuple(map(float, text.split(","))))
    parser.add_argument("--path", default="raster", choices=("raster", "simt"))
    parser.add_argument("--keep", help="keep both pictures of each model as .npz in this folder")
    options = parser.parse_args()
    gl = Gl()
    print(gl.name)
    for path in options.models:
        with tempfile.TemporaryDirectory() as folder:
            try:
                compare(gl, path, options, folder)
            except Unread as why:
                print(f"mesa_meshes.py: {path}: {why}", file=sys.stderr)
                return 3
    return 0


if __name__ == "__main__":
    sys.exit(main())
