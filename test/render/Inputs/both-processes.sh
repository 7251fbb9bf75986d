#!/bin/sh
# usage: both-processes.sh FOLDER CAPTURE OPTION...: trains with one process, and with two that one goes on from and two after it,
# three iterations of three views each, and compares all that is kept.
set -e
mpirun=$(dirname "$0")/mpirun.sh
out=$1
shift
mkdir "$out"
train="splat train $* --batch 3 --seed 3"
$train -o "$out/one.ply" --iterations 3 2>/dev/null
"$mpirun" -n 2 $train -o "$out/part.ply" --iterations 1 2>/dev/null
$train -o "$out/part.ply" --iterations 2 --resume 2>/dev/null
"$mpirun" -n 2 $train -o "$out/part.ply" --iterations 3 --resume 2>/dev/null
cmp "$out/one.ply" "$out/part.ply"
cmp "$out/one.ply.checkpoint" "$out/part.ply.checkpoint"
