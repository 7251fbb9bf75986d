"""Reads and writes files by names of every type and with every letter."""
import pathlib

import vorion

scene = vorion.Scene.read("s.ply")


def attempt(what, call, *arguments, **options):
    try:
        print(f"{what}: {len(call(*arguments, **options))}")
    except vorion.Error as e:
        print(ascii(f"{what}: {type(e).__name__}: {e}")[1:-1].replace("\\\\", "\\"))


attempt("Scene.read", vorion.Scene.read, "s.ply\0.spz")
attempt("Scene.read", vorion.Scene.read, b"s.ply\0")
attempt("Scene.write", scene.write, "o.ply\0.spz")
attempt("Camera.read", vorion.Camera.read, "c.json\0x", "front")
attempt("read_cameras", vorion.read_cameras, "c.json\0x")
attempt("Machine", vorion.Machine, set="raster.queue_depth=8\0x")
for name in ("str.ply", b"bytes.ply", pathlib.Path("path.ply"), "surrogate\udcff.ply"):
    scene.write(name)
    attempt(ascii(name), vorion.Scene.read, name)
attempt(ascii("none\udcff.ply"), vorion.Scene.read, "none\udcff.ply")
