#!/bin/sh
# What splat explore says of spaces that are wrong, of s.ply and c.json in this folder.
try() { # a parameter
  printf '{"parameters": {"first": {"key": "clusters", "values": [2]}, "p": %s}}' "$1" > wrong.json
  splat explore s.ply --cameras c.json -o w --space wrong.json --small-width 16 2>&1 && exit 1
}
try '{"key": "timing.raster.lans", "values": [8]}'
try '{"choices": {"c": {"timing.raster.lans": 8}}}'
try '{"key": "timing.raster.lanes", "values": [8, 77]}'
try '{"key": "timing.core.preset", "values": ["forwardin"]}'
try '{"option": "--size", "values": ["9x9"]}'
try '{"option": "--heat-map", "values": ["map"]}'
try '{"option": "--skip-saturated", "values": ["true"]}'
try '{"option": "--tile", "values": [32, 17]}'
try '{"option": "--pixel-unit", "values": ["last"]}'
true
