#!/bin/sh
# Asks every command of splat for a file of a kind that it does not write.
# usage: output-names.sh FOLDER, which splat-scene-samples has written to
cd "$1" || exit 1
scene=whole/degree1.ply
echo '[]' >c.json
attempt() {
  printf '%s: ' "$1"
  shift
  splat "$@" 2>&1
  echo "ended with $?"
}
view="--cameras c.json --view front"
attempt "convert to ksplat" convert $scene -o x.ksplat
attempt "convert without ending" convert $scene -o x
attempt "info as text" info $scene --json x.csv
attempt "render to gif" render $scene $view -o x.gif
attempt "depth as png" render $scene $view -o x.png --depth x.png
attempt "pairs as text" render $scene $view -o x.png --pairs x.csv
attempt "report as picture" render $scene $view -o x.png --json x.PNG
attempt "gradients as npy" gradients $scene $view --upstream u.npz -o x.npy
attempt "page as svg" analyze $scene $view --html x.svg
attempt "counts as svg" analyze $scene $view --json x.svg
attempt "demo as splat" demo-scene -o x.splat --gaussians 1000
attempt "demo's cameras" demo-scene -o x.ply --cameras x.txt --gaussians 1000
attempt "train to spz" train . -o x.spz
attempt "comparison as npz" compare a.npz b.npz --json x.npz
printf 'written:'
for file in x*; do [ -e "$file" ] && printf ' %s' "$file" || printf ' none'; done
echo
