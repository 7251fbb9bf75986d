#!/usr/bin/env bash
# Makes a fresh machine with Debian 12 or 13 ready: packages, sources, build. Every step
# is skipped when its result is there, so a second run is quick, needs no
# network, and goes on where a broken one stopped.
# usage: scripts/setup.sh [--demo | --tests]
# --demo: of the tools only those that draw and train scenes
# --tests: also the tests, and the packages that only they need
source "$(dirname "$0")/lib.sh"
showHelp "$@"
Tests='' Target=vorion_installed Built='built'
case "${1:-}" in
"") ;;
--demo) Target=vorion_demo Built='built what draws scenes; "scripts/setup.sh" builds the other tools' ;;
--tests) Tests=yes Target=all ;;
*) fail "unknown option $1, expected --demo or --tests" ;;
esac

readJobs

# Two in one folder would spoil each other. What this one starts holds the lock, too.
mkdir -p "$Root/build"
exec 9>"$Root/build/setup.lock"
flock -n 9 || fail "another one is running in $Root, expected that it has ended"

# Those after the line "# tests" with --tests only.
packages() {
  awk -v Tests="$Tests" -v Release="$(. /etc/os-release && echo "${VERSION_CODENAME:-}")" '
    /^# tests$/ && !Tests { exit }
    !/^#/ && (NF == 1 || $2 == Release) { print $1 }' "$Root/scripts/packages.txt"
}

missingPackages() {
  local Package
  for Package in $(packages); do
    dpkg-query -W -f '${Status}\n' "$Package" 2>/dev/null | grep -q 'ok installed' || echo "$Package"
  done
}

# aptGet ARGUMENTS...: apt-get, once no other process holds a lock that it needs: a fresh Debian updates itself. apt's
# DPkg::Lock::Timeout waits for dpkg's locks alone, and not for that of apt's lists.
aptGet() {
  local Errors="$Logs/packages-errors.log" Sudo='' Status Holder Said=''
  [ "$(id -u)" -eq 0 ] || Sudo=sudo # its password was asked for below
  while true; do
    Status=0
    $Sudo env LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive apt-get "$@" 2>"$Errors" || Status=$?
    cat "$Errors" >&2
    Holder=$(sed -nE 's/^E: Could not get lock (.*)\. It is held by (process .*)/\2 holds \1/p' "$Errors" | head -n 1)
    if [ "$Status" -eq 0 ] || [ -z "$Holder" ]; then
      return "$Status"
    fi
    [ "$Holder" = "$Said" ] || say "waiting for another package manager: $Holder"
    Said=$Holder
    sleep 1
  done
}

installPackages() {
  aptGet update
  # shellcheck disable=SC2046 # one word a package is what is wanted
  aptGet install -y --no-install-recommends $(missingPackages)
}

[ -r /etc/debian_version ] || fail "this is not a Debian machine; scripts/packages.txt lists what to install"
if [ -n "$(missingPackages)" ]; then
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || fail "not root and no sudo, expected one of them to install packages"
    sudo -v
  fi
  step "installing packages" packages installPackages
fi
step "fetching and patching LLVM's RISC-V target" source-llvm "$Root/scripts/fetch-source.sh" llvm
[ -z "$Tests" ] || step "unpacking LLVM's own RISC-V tests" source-llvm-tests "$Root/scripts/fetch-source.sh" llvm-tests
step "fetching and patching PoCL" source-pocl "$Root/scripts/fetch-source.sh" pocl
step "configuring" configure cmake --preset dev -S "$Root"
NINJA_STATUS='[%p] ' step "building (the first time several minutes)" build cmake --build "$Build" -j "$Jobs" --target "$Target"
printf '[%s] %s; ". scripts/env.sh" puts the tools on the path, and docs/tutorials/README.md shows their use\n' "$(elapsed)" "$Built"
