#!/bin/sh
# Renders a view on both paths and with the reference, and compares all three.
# usage: both-paths.sh SCENE CAMERAS VIEW FOLDER OPTIONS [MOST_DOUBTFUL]
# OPTIONS are of splat and splat-reference alike.
set -eu
scene=$1 cameras=$2 view=$3 out=$4 options=$5 doubtful=${6:-0.5}
rm -f "$out"/reference.npz "$out"/raster.npz "$out"/simt.npz
splat-reference "$scene" --cameras "$cameras" --view "$view" $options -o "$out/reference.npz"
for path in raster simt; do
  splat render "$scene" --cameras "$cameras" --view "$view" $options --path $path -o "$out/$path.npz"
  splat compare "$out/reference.npz" "$out/$path.npz" --mask "$out/reference.npz" \
    --min-db-all 60 --min-db 90 --max-doubtful "$doubtful"
done
splat compare "$out/raster.npz" "$out/simt.npz" --mask "$out/reference.npz" --min-db 100
