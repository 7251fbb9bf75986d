#!/usr/bin/env bash
# Runs the simulator's unit tests as on a host without AVX: under qemu-x86_64 -cpu Nehalem.
# usage: scripts/old-host.sh [PROGRAM...]   (PROGRAM: a test program of build/dev/bin; default: all of isasim/)
# exit codes: 0 all pass, 1 some fail
source "$(dirname "$0")/lib.sh"
showHelp "$@"
command -v qemu-x86_64 >/dev/null || fail "no qemu-x86_64, expected the package qemu-user"
Programs=("$@")
if [ $# -eq 0 ]; then
  # A test file is a program of its own, or part of its folder's.
  while read -r Source; do
    Name=$(basename "$Source" .cpp) Found=
    for Program in "isasim_$Name" "$Name" "$(basename "$(dirname "$Source")")_test"; do
      [ -n "$Found" ] || [ ! -x "$Build/bin/$Program" ] || Found=$Program
    done
    [ -n "$Found" ] || fail "no test program of $Source in $Build/bin"
    Programs+=("$Found")
  done < <(cd "$Root" && find isasim -name '*_test.cpp' | sort)
  mapfile -t Programs < <(printf '%s\n' "${Programs[@]}" | sort -u)
fi

mkdir -p "$Logs"
Failed=0
for Program in "${Programs[@]}"; do
  [ -x "$Build/bin/$Program" ] || fail "no test program '$Program' in $Build/bin"
  Begun=$SECONDS Status=0
  qemu-x86_64 -cpu Nehalem "$Build/bin/$Program" --gtest_brief=1 >"$Logs/old-host-$Program.log" 2>&1 || Status=$?
  Ran=$(sed -nE 's/^\[=+\] (.*) ran\..*/\1/p' "$Logs/old-host-$Program.log")
  printf '%s: %s, ended with %d after %d s\n' "$Program" "${Ran:-no count of tests}" "$Status" $((SECONDS - Begun))
  [ "$Status" -eq 0 ] || { Failed=1; grep -A 8 'Failure' "$Logs/old-host-$Program.log" | head -n 40 || tail -n 5 "$Logs/old-host-$Program.log"; }
done
exit "$Failed"
