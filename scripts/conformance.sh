#!/usr/bin/env bash
# Runs the programs of OpenCL's conformance suite that are built in a folder, and prints one table (docs/conformance.md).
# usage: scripts/conformance.sh FOLDER [--only PATTERN] [--limit SECONDS] [--jobs N] [--results FILE] [--json FILE]
#        scripts/conformance.sh --packages [FOLDER] [the same options]: those of the package piglit
source "$(dirname "$0")/lib.sh"
source "$Root/scripts/env.sh"
exec python3 "$Root/test/conformance/conformance.py" "$@"
