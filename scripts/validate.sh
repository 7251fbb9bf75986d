#!/usr/bin/env bash
# The clock beside references from other machines, as tables (docs/validation.md).
# usage: scripts/validate.sh [--peers FOLDER] [--ramulator CHECKOUT] [REFERENCES [KERNEL...]]   (REFERENCES: a folder, default:
# ../shared/data/timing; default: all kernels). FOLDER, or VORION_PEERS, has programs that run the other machines now: kernels,
# l2, loops and dram, or some of them (bench/timing/README.md). What they print takes the place of the references. CHECKOUT, or
# VORION_RAMULATOR, is a built checkout of Ramulator 2.1, beside which DRAM is run.
# exit codes: 0 all within their limits, 1 not so, or a peer failed, 2 usage, 3 a file is none of references
source "$(dirname "$0")/lib.sh"
showHelp "$@"
Peers=${VORION_PEERS:-}
Ramulator=${VORION_RAMULATOR:-}
while [[ "${1:-}" == -* ]]; do
  [ -n "${2:-}" ] || [[ $1 != --peers && $1 != --ramulator ]] || fail "$1: '', expected a folder"
  case $1 in
    --peers) Peers=$2 ;;
    --ramulator) Ramulator=$2 ;;
    *) fail "unknown option $1, expected --help, --peers, --ramulator or a folder" ;;
  esac
  shift 2
done
[ -z "$Ramulator" ] || command -v dram_patterns >/dev/null ||
  fail "--ramulator: no program dram_patterns, expected it on the path (bench/timing/README.md says how it is built)"
[ -z "$Peers" ] || [ -d "$Peers" ] || fail "$Peers: no such folder, expected one with the programs kernels, l2, loops or dram"
References=${1:-$Root/../shared/data/timing}
source "$Root/scripts/env.sh"
Timing=$Root/bench/timing

# Sets Peer to the option for a program of FOLDER, or to nothing where there is none of that name.
findPeer() {
  Peer=()
  [ -n "$Peers" ] && [ -x "$Peers/$1" ] || return 0
  Peer=(--peer "$Peers/$1")
}

Status=0
if [ -n "$Ramulator" ]; then
  printf 'DRAM beside Ramulator 2.1, with our tables:\n'
  "$Timing/dram_ramulator.py" "$Ramulator" || Status=$?
  printf '\n'
fi
findPeer kernels
"$Timing/kernels.py" "${Peer[@]}" "${@:2}" || Status=$?
findPeer l2
"$Timing/l2.py" "${Peer[@]}" "${@:2}" || Status=$?
if [ ! -d "$References" ]; then
  printf '\nvalidate.sh: loops and DRAM skipped: no folder %s with references\n' "$References"
  exit $Status
fi
findPeer loops
"$Timing/cores.py" "$References" "${Peer[@]}" || Status=$?
if [ -f "$References/vortex5_warps.json" ] || [ -f "$References/vortex5_cores.json" ]; then
  "$Timing/vortex5.py" "$References" || Status=$?
fi
if command -v dram_patterns >/dev/null; then
  printf '\nOne LPDDR4-3200 channel beside Ramulator:\n\n'
  findPeer dram
  "$Timing/dram.py" "$References/dram_lpddr4_3200.json" "$Timing/dram_references.json" "${Peer[@]}" || Status=$?
else
  printf '\nDRAM skipped: dram_patterns is not built (bench/timing/README.md)\n'
fi
exit $Status
