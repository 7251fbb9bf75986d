#!/bin/sh
# Renders samples of each format in FOLDER and their conversions to PLY: the
# pictures are the same, bit by bit. usage: each-format.sh FOLDER OUT
set -eu
cat >"$2/c.json" <<'EOF'
[{"id": 0, "img_name": "front", "width": 96, "height": 64, "position": [0, 0, -120],
  "rotation": [[1, 0, 0], [0, 1, 0], [0, 0, 1]], "fx": 80, "fy": 80}]
EOF
for scene in degree1.compressed.ply degree0.splat degree0.v2.spz degree1.v3.spz degree1.sog streamed.sog.d; do
  splat render "$1/$scene" --cameras "$2/c.json" --view front -o "$2/file.pfm" >"$2/log"
  splat convert "$1/$scene" -o "$2/scene.ply" >>"$2/log"
  splat render "$2/scene.ply" --cameras "$2/c.json" --view front -o "$2/ply.pfm" >>"$2/log"
  cmp "$2/file.pfm" "$2/ply.pfm"
  grep -q "^[1-9][0-9]* Gaussians seen, [1-9]" "$2/log"
  echo "$scene: as its PLY"
done
