#!/usr/bin/env python3
"""Fits a scene to a picture with NumPy: gradients from the machine, plain steps on the host.

usage: fit_picture.py SCENE CAMERAS.json VIEW [STEPS]

The goal is the picture of SCENE. The fit begins with paler colours and moved Gaussians, and prints the loss and the
machine's cycles of each step.
"""

import sys

import numpy as np
import vorion


def fit(machine, scene, camera, goal, steps):
    """Moves `scene` towards `goal`, the picture to be seen; gives the losses."""
    rates = {"means": 2e-3, "sh": 2e-1, "opacity_logits": 5e-1}
    losses = []
    image = machine.render(scene, camera, effects="flags").image
    for step in range(steps):
        difference = image - goal
        losses.append(float(np.mean(difference**2)))
        back = machine.gradients(scene, camera, 2 * difference / difference.size, of="stored", time=True)
        for name, rate in rates.items():
            values, gradient = getattr(scene, name), back.by[name]
            # Each parameter's largest step is its rate.
            values -= rate * gradient / max(float(np.abs(gradient).max()), 1e-12)
        print(f"step {step}: loss {losses[-1]:.6f}, {back.cycles} cycles")
        image = machine.render(scene, camera, effects="flags").image
    losses.append(float(np.mean((image - goal) ** 2)))
    return losses


def main():
    if len(sys.argv) not in (4, 5):
        sys.exit(__doc__)
    machine = vorion.Machine()
    scene, camera = vorion.Scene.read(sys.argv[1]), vorion.Camera.read(sys.argv[2], sys.argv[3])
    goal = machine.render(scene, camera).image
    random = np.random.default_rng(1)
    scene.sh *= 0.7
    scene.means += random.normal(scale=0.005, size=scene.means.shape).astype(np.float32)
    losses = fit(machine, scene, camera, goal, int(sys.argv[4]) if len(sys.argv) == 5 else 10)
    print(f"loss from {losses[0]:.6f} to {losses[-1]:.6f}")


if __name__ == "__main__":
    main()
