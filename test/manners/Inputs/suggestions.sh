#!/bin/sh
# suggestions.sh FOLDER: what is said of names that are nearly right, of a scene and a program in FOLDER.
cd "$1" || exit
try() { # name command...
  name=$1; shift
  printf '%s: %s\n' "$name" "$("$@" 2>&1)"
}
render() { name=$1; shift; try "$name" splat render s.ply --cameras c.json "$@"; }
render view --view frnot -o x.png
render "no view" --view bottom -o x.png
render ending --view front -o x.pgn
render path --view front -o x.png --path rastr
render unit --view front -o x.png --exp tabel
render size --view front -o x.png --tile 17
render effect --view front -o x.png --effects sh1,fanit
try knob splat accuracy s.ply --cameras c.json -o o --knobs tlie
try kernel vorion-sim k.elf --kernel subtrct --global 1 --arg buf:4
try key vorion-sim k.elf --set raster.quue_depth=8
try machine vorion-sim k.elf --config protype
try checker vorion-sim k.elf --kernel add --global 1 --arg buf:4 --check boundz
try subcommand splat rendr
try option splat render s.ply --camera c.json
try beginning vorion-sim k.elf --set cores_per=3
try "option begun" splat render s.ply --cam c.json
try "view begun" splat render s.ply --cameras c.json --view fro
try "unit begun" splat render s.ply --cameras c.json --exp tab
try "machine begun" vorion-sim k.elf --config scal
