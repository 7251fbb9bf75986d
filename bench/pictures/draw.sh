#!/usr/bin/env bash
# The pictures of docs/views-of-time.md and docs/viewer.md, of a frame of the demo scene, into docs/images/.
# usage: bench/pictures/draw.sh   (needs splat on the path, and chromium)
set -euo pipefail
Here=$(cd "$(dirname "$0")" && pwd)
Root=$Here/../..
Images=$Root/docs/images
Work=$Root/build/pictures
mkdir -p "$Work" && cd "$Work"
splat demo-scene -o scene.ply --cameras cameras.json
render() { splat render scene.ply --cameras cameras.json --view front "$@"; }

VORION_TIME=on VORION_TIMELINE=frame.json VORION_PROFILE=frame.txt render -o a.png --html a.html --heat-map a
render --tile 32 -o b.png --time --heat-map b
splat compare --times --across a.json b.json --html ab.html

Scene="splat demo-scene -o scene.ply --cameras cameras.json"
Command="splat render scene.ply --cameras cameras.json --view front -o a.png"
"$Here/timeline.py" frame.json "$Images/time-timeline.svg" --made "$Scene" \
  --made "VORION_TIME=on VORION_TIMELINE=frame.json $Command" --made "bench/pictures/timeline.py frame.json time-timeline.svg"
"$Here/profile.py" frame.txt "$Images/time-profile.svg" --sources "$Root/apps/splat/kernels" --made "$Scene" \
  --made "VORION_TIME=on VORION_PROFILE=frame.txt $Command" --made "bench/pictures/profile.py frame.txt time-profile.svg"
Stretch=file=frame.kanata,core=1,first=20000,count=60
VORION_TIME=on VORION_PIPELINE=$Stretch render -o a.png
"$Here/pipeline.py" frame.kanata "$Images/time-pipeline.svg" --made "$Scene" \
  --made "VORION_TIME=on VORION_PIPELINE=$Stretch $Command" --made "bench/pictures/pipeline.py frame.kanata time-pipeline.svg"
for Map in list blends cycles saturation; do
  cp "a.$Map.png" "$Images/time-$Map.png"
done
"$Here/page.py" a.html "$Images/time-page.png" --size 760x910
"$Here/page.py" ab.html "$Images/time-compared.png" --size 900x1175
"$Here/viewer.py" scene.ply cameras.json "$Images/viewer.png"
