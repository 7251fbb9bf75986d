# Source this: puts the tools and the Python package on the paths and shows the
# device to every OpenCL program of this shell.  . scripts/env.sh
VORION_ROOT=$(cd "$(dirname "${BASH_SOURCE[0]:-$0}")/.." && pwd)/build/dev
export VORION_ROOT
export PATH="$VORION_ROOT/bin:$PATH"
export OCL_ICD_VENDORS="$VORION_ROOT/etc/OpenCL/vendors"
export PYTHONPATH="$VORION_ROOT/lib/python3/dist-packages${PYTHONPATH:+:$PYTHONPATH}"
