"""Compares vorion.Camera.found with the view that splat render wrote. usage: found_view.py KIND...; s.KIND, KIND.json"""
import sys

import numpy as np
import vorion

for kind in sys.argv[1:]:
    found = vorion.Camera.found(vorion.Scene.read(f"s.{kind}"))
    written = vorion.Camera.read(f"{kind}.json", "found")
    assert (found.name, found.width, found.height) == ("found", 640, 360)
    assert np.allclose(found.world_to_camera, written.world_to_camera, rtol=0, atol=1e-12), kind
    assert np.allclose(found.intrinsics, written.intrinsics, rtol=0, atol=1e-9), kind
    print(f"{kind}: the same view")
