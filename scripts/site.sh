#!/usr/bin/env bash
# The documents as a site in build/dev/site, which a browser opens without a server or a network.
# usage: scripts/site.sh
source "$(dirname "$0")/lib.sh"
showHelp "$@"

command -v mkdocs >/dev/null || fail "no mkdocs, expected the package mkdocs-material, which scripts/setup.sh --tests installs"
mkdir -p "$Build"
"$Root/docs/site/build.py" "$Build/site" "$Build/bin"
printf 'open %s in a browser\n' "${Build#"$PWD"/}/site/index.html"
