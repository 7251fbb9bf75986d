#!/bin/sh
# usage: traced-lenses.sh FOLDER VIEWS
# Traces s.ply in FOLDER through the lenses of the views of l.json, and compares with the reference along rays.
set -e
cd "$1"
for view in $2; do
  splat-reference s.ply --cameras l.json --view "$view" --along-rays --order ray --dilation 0 -o "$view.npz"
  splat render s.ply --cameras l.json --view "$view" --renderer trace --path simt -o "$view-trace.npz" > "$view.log"
  echo "$view"
  splat compare "$view-trace.npz" "$view.npz" --mask "$view.npz" --min-db-all 60 --min-db 110 --max-doubtful 1
done
