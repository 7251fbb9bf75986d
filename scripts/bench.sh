#!/usr/bin/env bash
# Runs one of the measurements of bench/ with the tools of the build.
# usage: scripts/bench.sh isasim [OPTIONS]   (scripts/bench.sh isasim --help: its options)
source "$(dirname "$0")/lib.sh"
showHelp "$@"
Suite=${1:-}
[ -n "$Suite" ] && [ -x "$Root/bench/$Suite/run.py" ] || fail "unknown measurement '$Suite', expected isasim"
shift
source "$Root/scripts/env.sh"
exec "$Root/bench/$Suite/run.py" "$@"
