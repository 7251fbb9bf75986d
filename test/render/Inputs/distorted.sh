#!/bin/sh
# Draws each capture that distorted.py wrote through its lens, as its pinhole
# (which a sphere does not have), and through the same lens in cameras.json.
# usage: distorted.sh SCENE FOLDER
set -eu
scene=$1 folder=$2
for capture in "$folder"/*/; do
  name=$(basename "$capture")
  splat render "$scene" --cameras "$capture" --distorted -o "$folder/through.pfm" >"$folder/said"
  splat render "$scene" --cameras "$folder/own.json" --view "$name" -o "$folder/own.pfm" >"$folder/said"
  splat render "$scene" --cameras "$capture" -o "$folder/straight.pfm" >"$folder/said"
  cmp "$folder/through.pfm" "$folder/own.pfm"
  case $name in
    *sphere) cmp "$folder/through.pfm" "$folder/straight.pfm" ;;
    *) ! cmp -s "$folder/through.pfm" "$folder/straight.pfm" ;;
  esac
  echo "$name through its lens"
done
