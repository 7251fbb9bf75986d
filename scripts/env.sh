# Source this in bash or zsh: puts the tools and the Python package on the paths and
# shows the device to every OpenCL program of this shell.  . scripts/env.sh
if [ -n "${BASH_VERSION-}${ZSH_VERSION-}" ]; then
  # zsh calls a sourced file $0.
  VORION_ROOT=$(cd "$(dirname "${BASH_SOURCE:-$0}")/.." && pwd)/build/dev
  export VORION_ROOT
  export PATH="$VORION_ROOT/bin:$PATH"
  export OCL_ICD_VENDORS="$VORION_ROOT/etc/OpenCL/vendors"
  export PYTHONPATH="$VORION_ROOT/lib/python3/dist-packages${PYTHONPATH:+:$PYTHONPATH}"
else
  echo "env.sh: error: this is neither bash nor zsh, expected one of them" >&2
fi
