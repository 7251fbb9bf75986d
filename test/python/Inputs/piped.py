#!/usr/bin/env python3
"""Draws by the package that pip has installed."""

import os

import vorion

print(os.path.relpath(vorion.__file__))
machine = vorion.Machine()
picture = machine.render(vorion.Scene.read("s.ply"), vorion.Camera.read("c.json", "front"))
print(machine.name, "draws", "{} x {}".format(*picture.image.shape[:2]))
