#!/bin/sh
# replay.sh FOLDER PYTHON: reports of a scene in FOLDER, made again from elsewhere.
cd "$1" || exit
python=$2
splat render s.ply --cameras c.json --view front -o r.pfm --json r.json --time > said
splat render s.ply --cameras c.json --view all -o v.png --json v.json > said
splat analyze s.ply --cameras c.json --view front --json a.json > said
splat info s.ply --json=- > i.json 2> said
splat convert s.ply s.ply --scale 2 -o c.sog --json c2.json > said
splat convert s.ply -o c.spz --json=c3.json > said
mkdir -p sog && splat convert s.ply -o sog/meta.json --json sog.json > said
splat demo-scene --gaussians 1000 --cameras d.cameras.json --json d.json > said
splat render s.ply --cameras c.json --view front -o p.pfm --pairs p.npz > said
splat compare --pairs p.npz p.npz --json p.json > said
cd /
replay() { # name report
  printf '%s: ' "$1"
  [ "$1" != "other bits" ] || echo
  splat replay "$2" 2>&1 || echo "ended with $?"
}
folder=$1
find "$folder" -type f -exec md5sum {} + | sort > "$folder.before"
replay render "$folder/r.json"
replay views "$folder/v.json"
replay analyze "$folder/a.json"
replay info "$folder/i.json"
replay convert "$folder/c2.json"
replay spz "$folder/c3.json"
replay folder "$folder/sog.json"
replay demo-scene "$folder/d.json"
replay pairs "$folder/p.json"
find "$folder" -type f -exec md5sum {} + | sort | cmp - "$folder.before" && echo nothing was written
sed 's/"result_fnv1a64": "[^"]*"/"result_fnv1a64": "0000000000000000"/; s/"visible": 1/"visible": 7/' \
  "$folder/r.json" > "$folder/other.json"
replay "other bits" "$folder/other.json"
echo said for programs:
splat replay "$folder/other.json" --json - 2> "$folder/said" |
  "$python" -c 'import json, sys; r = json.load(sys.stdin); print(r["equal"], r["differing"], r["first_differences"][1])'
"$python" - "$folder/p.npz" "$folder/other.npz" <<'END'
import sys
import numpy
pairs = dict(numpy.load(sys.argv[1]))
pairs["depth_bits"][0] += 1
numpy.savez(sys.argv[2], **pairs)
END
splat compare --pairs "$folder/p.npz" "$folder/other.npz" --json - 2> "$folder/said" ||
  echo "ended with $?"
sed 's/^.*error/error/' "$folder/said"
# What this shell says of the machine is not what made it.
VORION_SET=clusters=1,sockets_per_cluster=1 replay "other machine" "$folder/r.json"
replay "no report" "$folder/c.json"
"$python" -c 'import sys; f = open(sys.argv[1], "r+b"); f.seek(-1, 2); f.write(b"\1")' "$folder/s.ply"
replay "changed scene" "$folder/r.json"
