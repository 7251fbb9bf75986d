#!/bin/sh
# Reads every damaged scene in FOLDER: each must end with exit code 3 and one
# line that names it. usage: each-damaged.sh FOLDER
count=0
for scene in "$1"/*; do
  splat info "$scene" >"$1.out" 2>"$1.err"
  code=$?
  if [ $code -ne 3 ] || [ "$(wc -l <"$1.err")" -ne 1 ] || [ -s "$1.out" ] ||
    ! grep -q "^splat: error: $scene" "$1.err"; then
    echo "$scene: exit code $code"
    cat "$1.out" "$1.err"
    exit 1
  fi
  count=$((count + 1))
done
echo "$count damaged scenes refused"
