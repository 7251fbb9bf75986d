# same-bits.sh FOLDER OPTIONS: one picture on both machines, for each clock and
# number of host threads.
set -e
first=
for shape in '"clusters": 1, "sockets_per_cluster": 2' '"clusters": 4, "sockets_per_cluster": 4'; do
  for threads in 1 3; do
    for clock in "" "--time"; do
      VORION_CONFIG="{$shape, \"host_threads\": $threads}" \
        splat render "$1/s.ply" --cameras "$1/c.json" --view front -o "$1/out.pfm" $clock $2 > "$1/log"
      [ -n "$first" ] || { first=1; mv "$1/out.pfm" "$1/first.pfm"; continue; }
      cmp "$1/first.pfm" "$1/out.pfm"
    done
  done
done
