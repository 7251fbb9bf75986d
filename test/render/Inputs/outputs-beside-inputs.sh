#!/bin/sh
# Names files of captures and scenes as outputs, in FOLDER, which has captures/, sog/, s.ply, c.json.
# usage: outputs-beside-inputs.sh FOLDER
cd "$1" || exit 1
mkdir list && cp c.json list/cameras.json
find . -type f | sort | xargs sha256sum >"$1.before"

attempt() {
  printf '%s: ' "$1"
  shift
  splat "$@" 2>&1
  echo "ended with $?"
}
transforms=captures/transforms
attempt "report over poses" train $transforms -o o.ply --json $transforms/transforms.json
attempt "checkpoint over a picture" train $transforms -o o.ply --checkpoint $transforms/pictures/a0.png
attempt "report over the other set" train captures/nerf-synthetic -o o.ply --json captures/nerf-synthetic/transforms_test.json
attempt "scores over poses" eval s.ply $transforms --json $transforms/transforms.json
attempt "picture over a SOG picture" render sog --cameras c.json --view front -o sog/sh0.webp
attempt "report over COLMAP's cameras" render s.ply --cameras captures/colmap-text --json captures/colmap-text/sparse/0/images.txt
attempt "analysis over a scene's description" analyze sog --cameras c.json --json sog/meta.json
attempt "report over the list in a folder" render s.ply --cameras list --view front -o p.png --json list/cameras.json
find . -type f | sort | xargs sha256sum | diff "$1.before" - && echo "changed: none"
