#!/bin/sh
# Gives splat every kind of file to write to, in FOLDER, which has s.ply and c.json.
# usage: files.sh FOLDER
cd "$1" || exit 1

attempt() {
  printf '%s: ' "$1"
  shift
  "$@" 2>&1
  echo "ended with $?"
}
info="splat info s.ply --json"
same() { # reports but for the name of their own file, which the command line in them has
  sed "s/\"$1\"/FILE/" "$1" > "$1.named" && sed "s/\"$2\"/FILE/;s/\"-\"/FILE/" "$2" > "$2.named"
  sed -i 's/"\(-\|pipe\)"/FILE/' "$1.named"
  cmp "$1.named" "$2.named"
}

echo old >new.json
chmod 604 new.json
attempt "a file with rights of its own" $info new.json >said
tail -n 1 said
stat -c 'has %a' new.json
mkdir sub
ln -s sub/target.json link.json
attempt "a link" $info link.json >said
tail -n 1 said
[ -L link.json ] && grep -c fnv1a64 sub/target.json
mkfifo pipe
timeout 60 cat pipe >piped.json &
attempt "a pipe" $info pipe >said
wait
tail -n 1 said
[ -p pipe ] && same piped.json new.json && echo same through the pipe
# Devices of our own, where some may be made: a mistake must not cost the machine's.
mknod null c 1 3 2>/dev/null || ln -s /dev/null null
mknod full c 1 7 2>/dev/null || ln -s /dev/full full
ln -s /proc/self/fd/1 stdout
attempt "a device" $info null >said
tail -n 1 said
[ -f null ] || echo still no file
splat info s.ply --json - 2>said >out.json
echo "standard output: ended with $?, $(same out.json new.json && echo same), $(grep -c "Gaussians*," said) lines beside it"
splat info s.ply --json stdout 2>said >out.json
echo "standard output by its other name: ended with $?, $(grep -c 'fnv1a64\|Gaussians*,' out.json) lines"

attempt "a full device" $info full
printf 'full standard output: '
splat info s.ply 2>&1 >/dev/full
echo "ended with $?"
printf 'full standard output for JSON: '
splat info s.ply --json - 2>&1 >/dev/full | grep error
printf 'closed standard output: '
splat info s.ply 2>&1 >&- | grep error
printf 'closed standard output is no file: '
splat info s.ply --json closed.json >&- 2>/dev/null
same closed.json new.json && echo true

ln s.ply hard.ply
cp s.ply before.ply
attempt "the scene itself" splat convert s.ply -o s.ply
attempt "its other spelling" splat convert s.ply -o sub/../s.ply
attempt "its hard link" splat convert s.ply -o hard.ply
attempt "its symbolic link" sh -c 'ln -s s.ply soft.ply; splat convert s.ply -o soft.ply'
attempt "the cameras as JSON" splat analyze s.ply --cameras c.json --view front --json ./c.json
ln -s d.ply d.json
attempt "two outputs of one file" splat demo-scene -o d.ply --cameras ./d.json --gaussians 1000
ln -s p.pfm p.json
attempt "a picture compared with itself" splat compare p.pfm p.pfm --json p.json
cmp s.ply before.ply && echo the scene is what it was
ls -A | grep '^\.' || echo nothing is left beside
