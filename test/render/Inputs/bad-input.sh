#!/bin/sh
# Runs splat on every kind of bad input in FOLDER, which has s.ply and c.json.
# usage: bad-input.sh FOLDER
cd "$1" || exit 1
head -c $(($(wc -c <s.ply) - 4)) s.ply >short.ply
echo "this is no scene" >text.ply
sed 's/property float opacity/property float opaqueness/' s.ply >property.ply
echo "this is no JSON" >text.json
sed 's/"fx"/"gx"/' c.json >keys.json
sed 's/^element vertex/comment Dilation: 3.41e38\n&/' s.ply >dilated.ply
mkdir folder.png

attempt() {
  printf '%s: ' "$1"
  shift
  splat "$@" 2>&1
  echo "ended with $?"
}
render() {
  title=$1 scene=$2 cameras=$3 view=$4 output=$5
  shift 5
  attempt "$title" render "$scene" --cameras "$cameras" --view "$view" -o "$output" "$@"
}

render "missing scene" none.ply c.json front p.png
render "truncated scene" short.ply c.json front p.png
render "not a scene" text.ply c.json front p.png
render "empty scene" /dev/null c.json front p.png
render "folder as scene" folder.png c.json front p.png
attempt "missing capture" train nowhere -o p.ply
attempt "file as capture" train text.ply -o p.ply
render "scene without opacity" property.ply c.json front p.png
render "cameras not JSON" s.ply text.json front p.png
render "camera without fx" s.ply keys.json front p.png
render "unknown view" s.ply c.json back p.png
render "no such folder" s.ply c.json front nowhere/p.png
render "folder as output" s.ply c.json front folder.png
render "unknown ending" s.ply c.json front p.gif
render "unknown support" s.ply c.json front p.png --support huge
render "unknown option" s.ply c.json front p.png --nonsense
attempt "view without cameras" render s.ply --view front -o p.png
render "cutoff of 1" s.ply c.json front p.png --cutoff 1
render "two background values" s.ply c.json front p.png --background 1,2
render "background not a number" s.ply c.json front p.png --background 0,nan,0
render "negative dilation" s.ply c.json front p.png --dilation -0.3
render "dilation not a number" s.ply c.json front p.png --dilation nan
render "dilation beyond floats" s.ply c.json front p.png --dilation 1e39
render "dilated beyond floats" dilated.ply c.json front p.png
attempt "converted beyond floats" convert s.ply --dilation 1e39 -o d.ply
for option in near dilation cutoff size axes json depth; do
  render "empty" s.ply c.json front p.png "--$option" ''
done
render "empty behind =" s.ply c.json front p.png --json=
attempt "empty scale" convert s.ply --scale '' -o d.ply
attempt "empty preset" train folder.png --preset '' -o p.ply
attempt "empty input" info ''
render "official16 by raster" s.ply c.json front p.png --support official16
render "table by simt" s.ply c.json front p.png --path simt --exp table
render "bf16 by simt" s.ply c.json front p.png --path simt --blend bf16
render "tile of 8" s.ply c.json front p.png --tile 8
render "no depth bits" s.ply c.json front p.png --depth-bits 0
render "no z-tiles" s.ply c.json front p.png --ztiles 0
render "too many z-tiles" s.ply c.json front p.png --ztiles 17
render "z-tiles by simt" s.ply c.json front p.png --path simt --ztiles 2
render "unknown hand-over" s.ply c.json front p.png --pixel-unit half
render "tile of 24" s.ply c.json front p.png --path simt --tile 24
render "official16 in tiles of 32" s.ply c.json front p.png --path simt --support official16 --tile 32
attempt "unknown subcommand" draw
attempt "too few Gaussians" demo-scene -o d.ply --gaussians 3
attempt "demo into nowhere" demo-scene -o nowhere/s.ply --gaussians 1000
printf 'left behind:'
for file in s.ply c.json short.ply text.ply property.ply text.json keys.json dilated.ply folder.png; do
  [ -e "$file" ] && printf ' %s' "$file" && rm -r "$file"
done
for file in *; do [ -e "$file" ] && printf ' %s' "$file"; done
echo
