# Source this in bash or zsh: puts the installed tools and the Python package on the
# paths and shows the device to every OpenCL program of this shell.
if [ -n "${BASH_VERSION-}" ] && [ "${BASH_SOURCE-}" = "$0" ]; then
  echo "env.sh: error: it was run, which changes nothing in this shell, expected: . $0" >&2
  exit 2
elif [ -n "${BASH_VERSION-}${ZSH_VERSION-}" ]; then
  # zsh calls a sourced file $0.
  VORION_ROOT=$(cd "$(dirname "${BASH_SOURCE:-$0}")/../.." && pwd)
  export VORION_ROOT
  # In front, and there once, however often this is sourced.
  case "$PATH:" in
  "$VORION_ROOT/bin:"*) ;;
  *) export PATH="$VORION_ROOT/bin:$PATH" ;;
  esac
  export OCL_ICD_VENDORS="$VORION_ROOT/pocl/lib/libpocl.so"
  case "${PKG_CONFIG_PATH-}:" in
  "$VORION_ROOT/lib/pkgconfig:"*) ;;
  *) export PKG_CONFIG_PATH="$VORION_ROOT/lib/pkgconfig${PKG_CONFIG_PATH:+:$PKG_CONFIG_PATH}" ;;
  esac
  case "${PYTHONPATH-}:" in
  "$VORION_ROOT/lib/python3/dist-packages:"*) ;;
  *) export PYTHONPATH="$VORION_ROOT/lib/python3/dist-packages${PYTHONPATH:+:$PYTHONPATH}" ;;
  esac
else
  echo "env.sh: error: this is neither bash nor zsh, expected one of them" >&2
fi
