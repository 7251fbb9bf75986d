"""Commands of splat as functions, and scores of pictures."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import tempfile

import numpy as np
from numpy.typing import ArrayLike

from . import _machine
from ._words import words

_CLASSES = {2: _machine.UsageError, 3: _machine.InputError, 4: _machine.TrapError, 5: _machine.LimitError}


def _program() -> str:
    root = os.environ.get("VORION_ROOT")
    found = os.path.join(root, "bin", "splat") if root else shutil.which("splat")
    if not found or not os.path.exists(found):
        raise _machine.InputError("splat is not found, expected VORION_ROOT or PATH to have it (scripts/env.sh)")
    return found


def command(name: str, *arguments: str | os.PathLike, **options: object) -> dict:
    """Runs `splat NAME ARGUMENTS... --OPTION=VALUE...` in a process of its own, and returns its report.

        vorion.command("train", "capture", iterations=300, output="scene.ply")
        vorion.command("accuracy", "scene.ply", cameras="cameras.json", min_db=45, output="study")

    Options are named as in `splat NAME --help`, with _ for -; True is a flag, a list repeats the option. Progress goes to
    standard error. The report is what the command's --json writes; {} of a command without one, as accuracy and explore,
    which write a folder. An error of the command is the exception of its exit code.
    """
    asked = []
    for key, value in options.items():
        for one in value if isinstance(value, list) else [value]:
            if one is True:
                asked.append("--" + key.replace("_", "-"))
            elif one is not None and one is not False:
                asked += words({key: os.fspath(one) if isinstance(one, os.PathLike) else one})
    with tempfile.TemporaryDirectory(prefix="vorion") as folder:
        report = os.path.join(folder, "report.json")
        if name not in ("accuracy", "explore") and "json" not in options:
            asked += ["--json", report]
        ran = subprocess.run([_program(), name, *(os.fspath(word) for word in arguments), *asked], stdout=subprocess.DEVNULL,
                             stderr=subprocess.PIPE, text=True, check=False)
        if ran.returncode:
            said = [line for line in ran.stderr.splitlines() if ": error: " in line]
            error = _CLASSES.get(ran.returncode, _machine.Error)
            problem = error(said[-1].split(": error: ", 1)[1] if said else ran.stderr.strip())
            problem.exit_code = ran.returncode
            raise problem
        if not os.path.exists(report):
            return {}
        with open(report, encoding="utf-8") as file:
            return json.load(file)


def compare(reference: ArrayLike, picture: ArrayLike, *, mask: ArrayLike | None = None) -> dict[str, float]:
    """Scores of a picture, arrays (H, W, C) of values of 0 to 1: {"psnr_db", "max_abs", "ssim"}, by the measures of
    `splat compare`.

    mask: (H, W); where it is not 0, the pixel is left out, and black in both pictures for SSIM's windows
    """
    a, b = np.asarray(reference, dtype=np.float64), np.asarray(picture, dtype=np.float64)
    if a.ndim != 3 or a.size == 0:
        raise _machine.UsageError(f"reference has the shape {a.shape}, expected (H, W, C)")
    if a.shape != b.shape:
        raise _machine.UsageError(f"picture has the shape {b.shape}, expected {a.shape}")
    kept = np.ones(a.shape[:2], dtype=bool) if mask is None else np.asarray(mask) == 0
    if kept.shape != a.shape[:2]:
        raise _machine.UsageError(f"mask has the shape {kept.shape}, expected {a.shape[:2]}")
    difference = np.abs(a - b)[kept]
    square = float(np.mean(difference ** 2))
    return {"psnr_db": float("inf") if square == 0 else -10 * float(np.log10(square)),
            "max_abs": float(difference.max(initial=0)),
            "ssim": _machine.ssim(a * kept[..., None], b * kept[..., None])}
