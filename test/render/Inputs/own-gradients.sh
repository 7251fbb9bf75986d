#!/bin/sh
# usage: own-gradients.sh FOLDER, which has s.ply, c.json and up.npz
cd "$1" || exit 1
gradients() {
  splat gradients s.ply --cameras c.json --view front "$@" >log 2>&1 || cat log
}
# What an archive holds, without its dates.
content() {
  python3 -c 'import hashlib, sys, zipfile; z = zipfile.ZipFile(sys.argv[1]); print(hashlib.sha256(b"".join(z.read(n) for n in z.namelist())).hexdigest())' "$1"
}
for machine in '"host_threads": 1' '"host_threads": 3' '"clusters": 2, "sockets_per_cluster": 1'; do
  VORION_CONFIG="{$machine}" gradients --upstream up.npz -o tree.npz
  content tree.npz
done >sums
printf 'tree: ' && head -n 1 sums
echo "different: $(sort -u sums | sed 1d | wc -l)"
count=0
for unit in even-left log-best mantissa-2; do
  gradients --upstream up.npz --reciprocal $unit -o $unit.npz
  [ "$(content tree.npz)" = "$(content $unit.npz)" ] || count=$((count + 1))
done
echo "differ from exact: $count"
gradients --upstream up.npz --sum rows -o rows.npz
[ "$(content tree.npz)" = "$(content rows.npz)" ] || echo "rows differ"

attempt() {
  printf '%s: ' "$1"
  shift
  splat gradients s.ply --cameras c.json --view front "$@" 2>&1
  echo "ended with $?"
}
python3 - <<'END'
import zipfile
zipfile.ZipFile("empty.npz", "w").writestr("other.npy", zipfile.ZipFile("up.npz").read("in_v_alpha.npy"))
END
python3 "$(dirname "$0")/upstream.py" small.npz 2 2
attempt "missing array" --upstream empty.npz -o g.npz
attempt "wrong size" --upstream small.npz -o g.npz
python3 - <<'END'
import zipfile
source, to = zipfile.ZipFile("up.npz"), zipfile.ZipFile("nan.npz", "w")
for name in source.namelist():
    data = bytearray(source.read(name))
    if name == "in_v_render.npy":
        data[-4:] = b"\0\0\xc0\x7f"
    to.writestr(name, bytes(data))
to.close()
END
attempt "no number" --upstream nan.npz -o g.npz
attempt "no folder" --upstream up.npz -o nowhere/g.npz
attempt "support" --upstream up.npz --support official16 -o g.npz
attempt "cores" --upstream up.npz --path simt --sum rows -o g.npz
