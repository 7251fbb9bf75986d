# Source this (bash): puts the installed tools on the path and shows the device
# to every OpenCL program of this shell.
VORION_ROOT=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
export VORION_ROOT
export PATH="$VORION_ROOT/bin:$PATH"
export OCL_ICD_VENDORS="$VORION_ROOT/pocl/lib/libpocl.so"
