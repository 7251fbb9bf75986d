#!/bin/sh
# The scene of this folder with each choice of units, as NAME.pfm and NAME.json.
set -e
draw() {
  name=$1 && shift
  splat render s.ply --cameras c.json --view front -o "$name.pfm" --json "$name.json" "$@" > /dev/null
}
draw default
draw tile16 --tile 16
for exp in poly2 poly3 poly4; do
  draw $exp --exp $exp
  draw $exp-simt --path simt --exp $exp
done
draw table64 --exp table64
draw bf16 --blend bf16
draw fp16 --blend fp16
draw alpha8 --alpha-cutoff 8
draw alpha8-simt --path simt --alpha-cutoff 8
draw depth24 --depth-bits 24
draw sh0 --sh-degree 0
