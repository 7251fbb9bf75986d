#!/usr/bin/env bash
# From a fresh machine to a picture: sets everything up, makes the project's
# own scene, renders it on the simulated GPU, and says where the results are.
# usage: scripts/demo.sh
source "$(dirname "$0")/lib.sh"
showHelp "$@"
[ $# -eq 0 ] || fail "unknown argument $1, expected none"

"$Root/scripts/setup.sh" --demo
source "$Root/scripts/env.sh"
Out="$Root/build/demo"
mkdir -p "$Out"
if [ ! -s "$Out/scene.ply" ] || [ ! -s "$Out/cameras.json" ]; then
  step "making the scene" demo-scene splat demo-scene -o "$Out/scene.ply" --cameras "$Out/cameras.json"
fi
printf '[%s] rendering at 960x544 on the simulated GPU\n' "$(elapsed)"
splat render "$Out/scene.ply" --cameras "$Out/cameras.json" --view front -o "$Out/demo.png" --json "$Out/demo.json"
printf '\npicture   %s\ncounters  %s\nnext      README.md, "First steps"\n' "${Out#"$PWD"/}/demo.png" "${Out#"$PWD"/}/demo.json"
