#!/usr/bin/env bash
# The clock beside references from other machines, as tables (docs/validation.md).
# usage: scripts/validate.sh [REFERENCES [KERNEL...]]   (a folder, default: ../shared/data/timing; default: all kernels)
# exit codes: 0 all within their limits, 1 not so, 2 usage
source "$(dirname "$0")/lib.sh"
showHelp "$@"
case "${1:-}" in -*) fail "unknown option $1, expected --help or a folder" ;; esac
References=${1:-$Root/../shared/data/timing}
source "$Root/scripts/env.sh"
Status=0
"$Root/bench/timing/kernels.py" "${@:2}" || Status=$?
if [ ! -d "$References" ]; then
  printf '\nvalidate.sh: loops and DRAM skipped: no folder %s with references\n' "$References"
  exit $Status
fi
"$Root/bench/timing/cores.py" "$References" || Status=$?
if command -v dram_patterns >/dev/null; then
  printf '\nOne LPDDR4-3200 channel beside Ramulator:\n\n'
  "$Root/bench/timing/dram.py" "$References/dram_lpddr4_3200.json" || Status=$?
else
  printf '\nDRAM skipped: dram_patterns is not built (bench/timing/README.md)\n'
fi
exit $Status
