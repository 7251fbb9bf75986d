#!/usr/bin/env bash
# Runs the tests whose judges are programs and libraries of others (test/peers), and prints what each decided.
# usage: scripts/peers.sh [--install]
# --install: first installs them, from Debian and into build/peers from the npm registry
source "$(dirname "$0")/lib.sh"
showHelp "$@"
case "${1:-}" in
"") ;;
--install)
  step "packages" peers-packages apt-get install -y --no-install-recommends colmap ffmpeg python3-opencv python3-pil \
    $(command -v npm >/dev/null || echo npm)
  step "npm's packages" peers-npm npm install --prefix "$Root/build/peers" --no-save --ignore-scripts \
    @playcanvas/splat-transform@2.7.1 @mkkellogg/gaussian-splats-3d@0.4.7 playcanvas@2.23.3 babylonjs@9.35.0 \
    babylonjs-loaders@9.35.0
  ;;
*) fail "unknown option $1, expected --install" ;;
esac
source "$Root/scripts/env.sh"
mkdir -p "$Logs"
Status=0
python3 /usr/lib/llvm-19/build/utils/lit/lit.py -a -j 1 --param "build=$Build" --xunit-xml-output "$Logs/peers.xml" \
  "$Root/test/peers" >"$Logs/peers.log" 2>&1 || Status=$?
sed -n 's/^# | \(peer .*\)/\1/p' "$Logs/peers.log"
python3 "$Root/scripts/count-tests.py" --skips '.*Missing required feature.*' "$Logs/peers.xml" || Status=1
exit "$Status"
