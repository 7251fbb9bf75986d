#!/bin/sh
# wrong_workloads.sh FOLDER: what splat explore says of workloads that are wrong, of the files in that folder.
try() { # a workload
  printf '%s' "$1" > "$folder/wrong.json"
  splat explore --workload "$folder/wrong.json" -o w 2>&1 && exit 1
}
scene() { # more keys of a scene
  try "{\"scenes\": [{\"scene\": \"s.ply\", \"cameras\": \"c.json\", $1}]}"
}
state() { # more keys of a state
  try "{\"training\": [{\"capture\": \"captures/colmap-binary\", $1}]}"
}
folder=$1
try '[]'
try '{"scenes": []}'
try '{"scene": [{"scene": "s.ply"}]}'
try '{"scenes": ["s.ply"]}'
scene '"camras": "c.json"'
scene '"view": {"front": 1}'
scene '"antialiased": 1'
scene '"weight": -1'
scene '"name": "a b"'
try '{"scenes": [{"scene": "s.ply", "cameras": "c.json"}, {"scene": "s.ply", "cameras": "c.json"}]}'
scene '"size": "9x"'
scene '"view": "side"'
try '{"scenes": [{"scene": "nothing.ply", "cameras": "c.json"}]}'
state '"downscale": 65'
state '"path": "simt"'
state '"absgrad": true'
state '"from": "s.ply"'
state '"from": "state", "sh-degree": 1'
true
