#!/usr/bin/env python3
"""Checks that kernels compile with a camera model: usage: lens_kernels.py KERNELS BUILD MACRO"""

import subprocess
import sys

kernels, build, macro = sys.argv[1:]
COMMON = ["TILE_SIZE=16", "SUPPORT_EXACT", "DILATION=0.3f", "ALPHA_CUTOFF=1.0f", "NEAR_LIMIT=0.2f", "MIN_POWER=-5.6f",
          "SH_DEGREE=1", *(f"USE_SH{band}=0" for band in (1, 2, 3)),
          *(f"USE_{effect}=1" for effect in ("VIEW_COLOR", "NEAR_PLANE", "FIELD_OF_VIEW", "FAINT")),
          *(f"USE_{effect}=0" for effect in ("ANTIALIAS", "INTERSECT_TAGS")), f"{macro}=1"]
for program, own in (("project.cl", ["SCENE_IN_BLOCKS"]), ("project_backward.cl", [])):
    for more in ([], ["USE_UNSCENTED=1"], ["USE_ROLLING_SHUTTER=1"], ["USE_NEEDLES=1"]):
        subprocess.run(["clang-19", "-x", "cl", "-cl-std=CL1.2", "--target=riscv32", "-fsyntax-only", "-Wno-unused-function",
                        "-Xclang", "-finclude-default-header", "-Wno-error", f"-I{kernels}",
                        f"-I{build}/intrinsics/generated/include", *(f"-D{define}" for define in COMMON + own + more),
                        f"{kernels}/{program}"], check=True)
