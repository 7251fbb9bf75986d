#!/bin/sh
# Gives vorion-sim every kind of file to write to, in FOLDER, which has k.elf (scale of kernel.s) and in (64 bytes).
# usage: files.sh FOLDER
cd "$1" || exit 1

# attempt TITLE A OUT [option...]: out = 1 * a
attempt() {
  printf '%s: ' "$1"
  a=$2 out=$3
  shift 3
  vorion-sim k.elf --global 16 --arg "$a" --arg "$out" --arg i32:1 --arg local:4 "$@" 2>&1
  echo "ended with $?"
}

cp in before
# A device of our own, where one may be made: a mistake must not cost the machine's.
mknod full c 1 7 2>/dev/null || ln -s /dev/full full
mkfifo pipe
timeout 60 cat pipe >piped &
attempt "a pipe" buf@in out:64@pipe
wait
[ -p pipe ] && cmp piped in && echo the same came through
ln -s target link
attempt "a link" buf@in out:64@link
[ -L link ] && cmp target in && echo a link still, and its target is the same
cp in place
attempt "in its place" inout:place buf:64
attempt "a full device" buf@in out:64@full
attempt "a full trace" buf@in out:64@out --trace all:full
printf 'full standard output: '
vorion-sim --print-default-config 2>&1 >/dev/full
echo "ended with $?"
attempt "the program" buf@in out:64@k.elf
attempt "two of one name" buf@in out:64@./out --stats=out
attempt "an input" buf@in out:64@./in
attempt "a slip" buf@in out:64@out --kernl scale
cmp in before && echo the input is what it was
