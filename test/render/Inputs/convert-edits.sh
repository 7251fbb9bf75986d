#!/bin/sh
# Changes the scene s.ply of FOLDER in every way that splat convert has.
# usage: convert-edits.sh FOLDER
cd "$1" || exit 1
attempt() {
  splat convert "$@" 2>&1
  echo "ended with $?"
}
echo "box.ply: 600"
splat convert s.ply -o box.ply --crop-box -1,-1,0,1,1,2
splat convert s.ply -o sphere.ply --crop-sphere 0,0,2,1.5
splat convert s.ply -o thin.ply --drop-faint 0.3 --sh-degree 1
splat convert s.ply thin.ply s.ply -o twice.ply --crop-box -99,-99,-99,99,99,99 >said
splat convert s.ply s.ply -o joined.ply | sed -n 's/^joined.ply/joined/p'
# A quarter turn about x takes y to z and z to -y; the camera goes with it.
splat convert s.ply -o moved.ply --rotate 90,0,0 --translate 3,4,5 >said
sed 's/"position": \[[^]]*\]/"position": [3, 4, 5]/; s/"rotation": \[\[.*\]\]/"rotation": [[1, 0, 0], [0, 0, -1], [0, 1, 0]]/' c.json >m.json
splat render s.ply --cameras c.json -o s.pfm >said
splat render moved.ply --cameras m.json -o m.pfm >said
splat compare s.pfm m.pfm --min-db 60 >compared && echo "a moved scene from a moved camera is the same"
# Doubles far away come home: fp32 holds no more there than halves.
splat convert far.ply -o home.ply --translate=-412345,-5654321,-120 | sed -n '$s/^/home: /p'
splat convert far.ply -o floats.ply | sed -n '$s/^/far: /p'
splat convert s.ply -o gone.ply --translate=412345,5654321,120 | sed -n '$s/^/gone: /p'
splat convert far.ply -o corner.ply --crop-box 412344.9,5654320.9,0,412345.1,5654321.1,999 | sed -n '1s/^/corner: /p'
splat convert s.ply -o corner.ply --crop-box=-0.1,-0.1,-120,0.1,0.1,879 | sed -n '1s/^/corner: /p'
splat render home.ply --cameras c.json -o h.pfm >said
splat compare s.pfm h.pfm --min-db 100 >compared && echo "doubles from far away are drawn as at home"
attempt s.ply -o no.ply --crop-sphere 99,0,0,1
attempt s.ply -o no.ply --scale=-1
attempt s.ply -o no.ply --crop-box 1,0,0,0,1,1
attempt s.ply -o no.ply --rotate nan,0,0
sed 's/^format.*/&\ncomment SplatRenderMode: mip/' s.ply >b.ply
attempt s.ply b.ply -o no.ply
attempt s.ply -o no.ply --translate 1e39,0,0
attempt s.ply -o no.ply --scale 3e38
