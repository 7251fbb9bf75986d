#!/usr/bin/env bash
# The stranger's machine: a fresh Debian root with nothing but a clone of
# this repository in it, in which demo.sh (twice, the second time without a
# network) and test.sh are run and timed. Needs root and debootstrap.
# usage: scripts/fresh-root.sh NEW_FOLDER [bookworm|trixie]   (Debian 12 or 13; the folder is kept, to look into)
source "$(dirname "$0")/lib.sh"
showHelp "$@"

Machine=${1:-}
Release=${2:-bookworm}
[ -n "$Machine" ] || fail "no folder given, expected: fresh-root.sh NEW_FOLDER [bookworm|trixie]"
case "$Release" in bookworm | trixie) ;; *) fail "unknown release $Release, expected bookworm or trixie" ;; esac
[ "$(id -u)" -eq 0 ] || fail "not root, and chroot and mount need it"
command -v debootstrap >/dev/null || fail "debootstrap is not installed"

makeRoot "$Machine" "$Release"
git clone --quiet "$Root" "$Machine/vorion"

timed() { # timed TITLE COMMAND...
  local Title=$1 Begin=$SECONDS Status=0
  shift
  printf '\n== %s\n' "$Title"
  "$@" || Status=$?
  printf '== %s: %d:%02d, exit code %d\n' "$Title" $(((SECONDS - Begin) / 60)) $(((SECONDS - Begin) % 60)) "$Status"
  return "$Status"
}
Clean=(env -i HOME=/root "PATH=/usr/sbin:/usr/bin:/sbin:/bin" LANG=C.UTF-8)
timed "demo.sh, first time" chroot "$Machine" "${Clean[@]}" /vorion/scripts/demo.sh
timed "demo.sh, second time, without a network" unshare -n chroot "$Machine" "${Clean[@]}" /vorion/scripts/demo.sh
timed "test.sh" chroot "$Machine" "${Clean[@]}" /vorion/scripts/test.sh
