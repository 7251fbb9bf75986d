#!/bin/sh
# json-stdout.sh FOLDER PYTHON: the schema of each report that --json - prints.
set -eu
cd "$1"
python=$(echo "$2" | tr -d '"')
try() { # name command...
  name=$1; shift
  "$@" --json - 2> said | "$python" -c 'import json, sys; print(sys.argv[1] + ": " + json.load(sys.stdin)["schema"]["name"])' "$name"
}
try info splat info s.ply
try analyze splat analyze s.ply --cameras c.json --view front
try render splat render s.ply --cameras c.json --view front -o one.pfm
try views splat render s.ply --cameras c.json --view all -o all.pfm
try compare splat compare one.pfm one.pfm
