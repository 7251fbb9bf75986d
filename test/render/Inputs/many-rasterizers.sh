# usage: many-rasterizers.sh FOLDER OPTIONS: the same picture on the default machine and on one with 1,024 rasterizers.
set -e
cd "$1"
export VORION_CONFIG='{"machine": "scaled", "clusters": 256, "stack_bytes": 16384}'
splat render s.ply --cameras c.json --view front -o large.pfm $2
unset VORION_CONFIG
splat render s.ply --cameras c.json --view front -o default.pfm $2 > default.txt
cmp default.pfm large.pfm
