#!/bin/sh
# replay.sh FOLDER PYTHON: reports of a scene in FOLDER, made again from elsewhere.
cd "$1" || exit
python=$(echo "$2" | tr -d '"')
splat render s.ply --cameras c.json --view front -o r.pfm --json r.json --time > said
splat render s.ply --cameras c.json --view all -o v.png --json v.json > said
splat analyze s.ply --cameras c.json --view front --json a.json > said
splat info s.ply --json=- > i.json 2> said
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
find "$folder" -type f -exec md5sum {} + | sort | cmp - "$folder.before" && echo nothing was written
sed 's/"result_fnv1a64": "[^"]*"/"result_fnv1a64": "0000000000000000"/; s/"visible": 1/"visible": 7/' \
  "$folder/r.json" > "$folder/other.json"
replay "other bits" "$folder/other.json"
# What this shell says of the machine is not what made it.
VORION_SET=clusters=1,sockets_per_cluster=1 replay "other machine" "$folder/r.json"
replay "no report" "$folder/c.json"
"$python" -c 'import sys; f = open(sys.argv[1], "r+b"); f.seek(-1, 2); f.write(b"\1")' "$folder/s.ply"
replay "changed scene" "$folder/r.json"
