#!/usr/bin/env bash
# Format and static analysis of the code we wrote; part of scripts/test.sh.
# usage: scripts/lint.sh [--fix | --all | --seconds N]
# --fix: formats in place, without analysis
# --all: analyses the tests too, and what has not changed since it passed
# --seconds N: analyses no further file after so long, and says how many are left
source "$(dirname "$0")/lib.sh"
showHelp "$@"
cd "$Root"

mapfile -t Sources < <(git ls-files '*.cpp' '*.cc' '*.h' '*.c')
if [ "${1:-}" = --fix ]; then
  clang-format-19 -i "${Sources[@]}"
  exit 0
fi
clang-format-19 --dry-run -Werror "${Sources[@]}"

# clang-tidy.py knows the other options.
"$Root/scripts/clang-tidy.py" "$Build" "$Root" "$@"
