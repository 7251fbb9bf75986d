# A scene and its camera, moved by offsets at which fp32 has few digits.
# Usage: far-scenes.sh FOLDER INPUTS
cd "$1" || exit 1
python3 "$2/scene.py" random s.ply c.json
splat render s.ply --cameras c.json -o home.pfm >said
while read -r name x y z; do
  python3 "$2/far_doubles.py" s.ply "$name.ply" "$x" "$y" "$z"
  sed "s/\"position\": \[[^]]*\]/\"position\": [$x, $y, $z]/" c.json >"$name.json"
  splat render "$name.ply" --cameras "$name.json" -o "$name.pfm" --write-cameras "$name.out.json" >said
  splat compare home.pfm "$name.pfm" --min-db 100 >compared && echo "$name: as at home"
  python3 -c 'import json, sys; print(sys.argv[1] + ":", json.load(open(sys.argv[1] + ".out.json"))[0]["position"])' "$name"
done <<EOF
km20 20000 -20000 20000
km200 200000 -200000 200000
utm 412345 5654321 120
ecef 4000123 900321 4870456
EOF
