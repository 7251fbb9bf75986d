# Source this in bash or zsh: puts the tools and the Python package of its tree on the
# paths and shows the device to every OpenCL program of this shell.  . scripts/env.sh
# In the repository, as scripts/env.sh, its tree is build/dev; installed, as
# share/vorion/env.sh, it is the one in which it lies.
if [ -n "${BASH_VERSION-}" ] && [ "${BASH_SOURCE-}" = "$0" ]; then
  echo "env.sh: error: it was run, which changes nothing in this shell, expected: . $0" >&2
  exit 2
elif [ -n "${BASH_VERSION-}${ZSH_VERSION-}" ]; then
  # zsh calls a sourced file $0.
  VORION_ROOT=$(cd "$(dirname "${BASH_SOURCE:-$0}")" && pwd)
  # Paths have it in front, and there once, however often this is sourced.
  case "$VORION_ROOT" in
  */share/vorion)
    VORION_ROOT=${VORION_ROOT%/share/vorion}
    # A file there would have to name a folder, and the tree can be moved.
    export OCL_ICD_VENDORS="$VORION_ROOT/pocl/lib/libvorion-pocl.so"
    case "${PKG_CONFIG_PATH-}:" in
    "$VORION_ROOT/lib/pkgconfig:"*) ;;
    *) export PKG_CONFIG_PATH="$VORION_ROOT/lib/pkgconfig${PKG_CONFIG_PATH:+:$PKG_CONFIG_PATH}" ;;
    esac
    ;;
  *)
    VORION_ROOT=${VORION_ROOT%/*}/build/dev
    export OCL_ICD_VENDORS="$VORION_ROOT/etc/OpenCL/vendors"
    ;;
  esac
  export VORION_ROOT
  case "$PATH:" in
  "$VORION_ROOT/bin:"*) ;;
  *) export PATH="$VORION_ROOT/bin:$PATH" ;;
  esac
  case "${PYTHONPATH-}:" in
  "$VORION_ROOT/lib/python3/dist-packages:"*) ;;
  *) export PYTHONPATH="$VORION_ROOT/lib/python3/dist-packages${PYTHONPATH:+:$PYTHONPATH}" ;;
  esac
else
  echo "env.sh: error: this is neither bash nor zsh, expected one of them" >&2
fi
