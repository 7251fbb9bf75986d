#!/usr/bin/env bash
# Makes the note of docs/report/ from the results of scripts/paper.sh.
# usage: scripts/report.sh [--results FOLDER] [--out FOLDER] [--no-pdf]   (--help: all options)
source "$(dirname "$0")/lib.sh"
source "$Root/scripts/env.sh"
exec python3 "$Root/bench/paper/report.py" "$@"
