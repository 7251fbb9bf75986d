"""Where pip built the package (pyproject.toml): OpenCL finds the device there without env.sh."""

import os

try:
    from ._built import ROOT  # type: ignore[import]
except ImportError:  # the tree's own copy, or an installed one: env.sh or the system has told OpenCL
    ROOT = None

if ROOT and "VORION_ROOT" not in os.environ:
    os.environ["VORION_ROOT"] = ROOT
    os.environ.setdefault("OCL_ICD_VENDORS", os.path.join(ROOT, "etc", "OpenCL", "vendors"))
