#!/bin/sh
# Draws FOLDER/s.ply with every output beside the picture, and once without.
# usage: layers.sh FOLDER PATH PYTHON... (which checks them)
set -eu
folder=$1 path=$2
shift 2
draw() {
  splat render "$folder/s.ply" --cameras "$folder/c.json" --size 96x54 --alpha-cutoff 8 --path "$path" "$@" >"$folder/said"
}
draw -o "$folder/alone.npz"
draw -o "$folder/picture.npz" --depth "$folder/accumulated.npz" --normals "$folder/normals.npz" \
  --opacity "$folder/opacity.npz" --contributors "$folder/every.npz" --top 64
cmp "$folder/alone.npz" "$folder/picture.npz"
draw -o "$folder/picture.npz" --depth "$folder/expected.npz" --depth-as expected --contributors "$folder/top.npz" --top 2
draw -o "$folder/picture.npz" --depth "$folder/median.npz" --depth-as median
cmp "$folder/alone.npz" "$folder/picture.npz"
cd "$folder"
"$@" picture.npz accumulated.npz expected.npz median.npz normals.npz opacity.npz every.npz top.npz s.ply c.json
