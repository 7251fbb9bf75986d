"""The modules of intrinsics/generate, which know the machine's records, for the scripts that use them."""

import os
import sys

sys.path.append(os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "intrinsics", "generate"))

import clock  # noqa: E402,F401
import records  # noqa: E402,F401
