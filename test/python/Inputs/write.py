#!/usr/bin/env python3
"""Writes scenes of arrays and of a file, and holds them against splat convert's. Runs in a folder with s.ply."""

import json
import pathlib
import subprocess

import numpy as np
import vorion

scene = vorion.Scene.read("s.ply")
for ending in ("ply", "compressed.ply", "splat", "spz", "sog"):
    lost = scene.write(f"mine.{ending}")
    subprocess.run(["splat", "convert", "s.ply", "-o", f"its.{ending}", "--json", "its.json"], check=True,
                   stdout=subprocess.DEVNULL)
    assert pathlib.Path(f"mine.{ending}").read_bytes() == pathlib.Path(f"its.{ending}").read_bytes(), ending
    its = json.loads(pathlib.Path("its.json").read_text())
    assert {name: lost[name] for name in its["lost"]} == its["lost"], ending
    assert lost["sh_degree"] == scene.sh_degree - its["sh_degree"] and lost["drawing"] != its["keeps_drawing"], ending

numbers = np.random.default_rng(5)
made = vorion.Scene(numbers.normal(size=(7, 3)), numbers.normal(size=(7, 3)), numbers.normal(size=(7, 4)),
                    numbers.normal(size=7), numbers.normal(size=(7, 9, 3)), antialiased=True, dilation=0.1)
assert set(made.write(pathlib.Path("made.ply")).values()) == {0}
again = vorion.Scene.read("made.ply")
for name in ("means", "log_scales", "quats", "opacity_logits", "sh"):
    assert getattr(again, name).tobytes() == getattr(made, name).tobytes(), name
assert (again.antialiased, again.dilation) == (True, 0.1)
lost = made.write("made.splat")
assert lost["sh_degree"] == 2 and lost["harmonics"] > 0 and lost["drawing"], lost
