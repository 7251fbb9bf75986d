#!/usr/bin/env python3
"""Checks the sample vorion_torch.

usage: torch_function.py FOLDER, which has s.ply and c.json
"""

import os
import sys

import numpy as np
import torch
import vorion
import vorion_torch

os.chdir(sys.argv[1])
machine, camera = vorion.Machine(), vorion.Camera.read("c.json", "front")
scene = vorion.Scene.read("s.ply")
stored = {name: torch.tensor(getattr(scene, name), requires_grad=True) for name in vorion_torch.NAMES}
weights = torch.linspace(-1, 1, camera.height * camera.width * 3).reshape(camera.height, camera.width, 3)


def loss(image, alpha):
    return (image * weights).sum() + 0.5 * alpha.sum()


image, alpha = vorion_torch.rasterize(machine, camera, **stored)
assert image.detach().numpy().tobytes() == machine.render(scene, camera).image.tobytes()
loss(image, alpha).backward()
back = machine.gradients(scene, camera, weights.numpy(), np.full(alpha.shape, 0.5), of="stored")
for name, tensor in stored.items():
    assert tensor.grad.numpy().tobytes() == back.by[name].tobytes(), name

# By activated scales, in double, through torch.log.
scales = torch.exp(stored["log_scales"].detach().double()).requires_grad_()
loss(*vorion_torch.rasterize(machine, camera, stored["means"].detach(), torch.log(scales).float(), stored["quats"].detach(),
                             stored["opacity_logits"].detach(), stored["sh"].detach())).backward()
wanted = back.by["log_scales"] / scales.detach().numpy()
assert np.allclose(scales.grad.numpy(), wanted, rtol=1e-3, atol=1e-5 * np.abs(wanted).max())

# A few steps of an optimizer.
goal = image.detach() * 0.8
optimizer = torch.optim.Adam([stored["sh"]], lr=0.05)
losses = []
for _ in range(4):
    optimizer.zero_grad()
    error = ((vorion_torch.rasterize(machine, camera, **stored)[0] - goal) ** 2).mean()
    error.backward()
    optimizer.step()
    losses.append(float(error))
assert losses[-1] < losses[0], losses
