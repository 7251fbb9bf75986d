"""What the tests of pictures and of gradients share."""

import numpy as np


def same(got, wanted, what):
    """Fails unless two arrays have the same bits."""
    assert got.dtype == wanted.dtype and got.itemsize == 4, what
    assert got.shape == wanted.shape, (what, got.shape, wanted.shape)
    assert got.tobytes() == wanted.tobytes(), f"{what} differs"


def same_picture(got, file, prefix=""):
    """Fails unless a Picture has the bits of what splat wrote."""
    wanted = np.load(file)
    same(got.image, wanted[prefix + "render"], file + " image")
    same(got.alpha, wanted[prefix + "alpha"], file + " alpha")
