#!/usr/bin/env bash
# Measures what the paper says about rendering and training, and writes docs/paper-results.md.
# usage: scripts/paper.sh [--out FOLDER] [--scenes NAME...] [--jobs N] ...   (--help: all options)
source "$(dirname "$0")/lib.sh"
source "$Root/scripts/env.sh"
exec python3 "$Root/bench/paper/run.py" "$@"
