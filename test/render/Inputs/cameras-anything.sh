#!/bin/sh
# Renders with every kind of cameras in FOLDER; pictures must agree to 8 bits.
# usage: cameras-anything.sh FOLDER
cd "$1" || exit 1
splat render s.ply --cameras inria.json -o inria.pfm | head -n 1
for cameras in colmap colmap/sparse/0 colmap/sparse/0/images.txt transforms.json path.json; do
  splat render s.ply --cameras $cameras -o other.pfm >said || exit
  # Rotations went through text, so the last bits of a pixel may differ.
  splat compare inria.pfm other.pfm --min-db 60 >compared && echo "the same from $cameras"
  rm other.pfm
done
splat render s.ply --cameras inria.json --orbit 4 --size 48x32 -o o.png >said
echo o.*.png | sed 's/o\.\([^ ]*\)\.png/\1/g'
splat render s.ply --cameras c.json --frames 3 --size 48x32 -o f.png >said
echo f.*.png | sed 's/f\.\([^ ]*\)\.png/\1/g'
splat analyze s.ply --size 64 | sed -n '1s/ .*//p' | sed 's/^/analyzed /'
splat render s.ply --size 96x54 -o a.pfm >said && splat render s.ply --size 96x54 -o b.pfm >said && cmp a.pfm b.pfm && echo "the same twice"
splat render s.ply --frames 3 -o no.png 2>&1
splat render s.ply --size 96x -o no.png 2>&1
splat render s.ply --cameras none.json -o no.png 2>&1
true
