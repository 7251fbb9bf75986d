"""The machine behind a training loop of PyTorch: its picture with gradients, as a function of tensors.

    import vorion_torch
    image, alpha = vorion_torch.rasterize(machine, camera, means, log_scales, quats, opacity_logits, sh)
    loss(image).backward()

The tensors are a scene's parameters as they are stored (vorion.Scene). Who has scales and opacities gives torch.log(scales)
and torch.logit(opacities), and PyTorch takes the gradients on.
"""

import numpy as np
import torch
import vorion

NAMES = ("means", "log_scales", "quats", "opacity_logits", "sh")


class _Rasterize(torch.autograd.Function):
    @staticmethod
    def forward(context, machine, camera, options, *tensors):
        scene = vorion.Scene(*(t.detach().cpu().numpy() for t in tensors))
        picture = machine.render(scene, camera, effects="flags", **options)
        context.made_of = machine, camera, options, scene, [(t.device, t.dtype) for t in tensors]
        return tuple(torch.from_numpy(a).to(tensors[0]) for a in (picture.image, picture.alpha))

    @staticmethod
    def backward(context, v_image, v_alpha):
        machine, camera, options, scene, kinds = context.made_of
        v_image, v_alpha = (np.ascontiguousarray(v.detach().cpu().numpy(), dtype=np.float32) for v in (v_image, v_alpha))
        by = machine.gradients(scene, camera, v_image, v_alpha, of="stored", **options).by
        found = (torch.from_numpy(by[name]).to(device=device, dtype=dtype)
                 for name, (device, dtype) in zip(NAMES, kinds))
        return (None, None, None, *found)


def rasterize(machine, camera, means, log_scales, quats, opacity_logits, sh, **options):
    """The image (H, W, 3) and alpha (H, W); options are those that render() and gradients() share."""
    return _Rasterize.apply(machine, camera, options, means, log_scales, quats, opacity_logits, sh)
