# The same bits of colour and alpha, whatever is compiled in.
# usage: same-effects.sh SCENE CAMERAS FOLDER OPTIONS [VIEW]
set -e
for effects in auto all flags; do
  # shellcheck disable=SC2086 # OPTIONS are several words
  splat render "$1" --cameras "$2" --view "${5:-front}" --effects "$effects" $4 -o "$3/$effects.npz" --json "$3/$effects.json" > /dev/null
done
splat render "$1" --cameras "$2" --view "${5:-front}" $4 -o "$3/auto.pfm" > /dev/null
cmp "$3/auto.npz" "$3/all.npz"
cmp "$3/auto.npz" "$3/flags.npz"
