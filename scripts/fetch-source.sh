#!/bin/sh
# Fetch, check, unpack and patch one of the two source packages that are built
# here rather than installed: LLVM's RISC-V target with the tools that link it
# (and, apart from it, LLVM's own tests of that target), and PoCL. They come through apt with a configuration of its own, so that the
# system's sources and lists stay as they are.
#
# The result is build/sources/NAME. It is made from an untouched copy and our
# patches, again only when one of these changes, so a second run does nothing
# and needs no network; a run that broke off resumes.
set -eu

usage() {
  cat <<'TEXT'
usage: fetch-source.sh llvm|llvm-tests|pocl

Unpacks and patches a source package into build/sources/NAME.

environment:
  VORION_SOURCES       folder for the sources (default: build/sources)
  VORION_LLVM_SOURCE   where to take the package's files from instead of apt:
  VORION_POCL_SOURCE   files, folders or file addresses, separated by spaces

exit codes: 0 done, 2 usage, 3 cannot get or check a file, 4 a patch does not apply
TEXT
}

fail() { # code message
  code=$1; shift
  echo "fetch-source: error: $*" >&2
  exit "$code"
}

say() { echo "fetch-source: $*" >&2; }

case ${1:-} in
-h | --help) usage; exit 0 ;;
llvm | llvm-tests | pocl) name=$1 ;;
*) usage >&2; exit 2 ;;
esac

root=$(cd "$(dirname "$0")/.." && pwd)
sources=${VORION_SOURCES:-$root/build/sources}

# The Debian release of this machine; on others the sources come from the environment.
release=$(. /etc/os-release && echo "${VERSION_CODENAME:-}")
case $release in trixie) revision=3 ;; *) release=bookworm revision='3~deb12u1' ;; esac

# What each package consists of: its version, where Debian keeps it, the files
# with their hashes, and what of it we need ("" = everything).
case $name in
llvm | llvm-tests)
  package=llvm-toolchain-19 version=1:19.1.7-$revision suite=$release
  files="llvm-toolchain-19_19.1.7.orig.tar.xz:ae498f3bc58ae2d9f64ef5f0c035c4240152bf015a5b7738b15c22e93bdc97ce"
  override=${VORION_LLVM_SOURCE:-}
  patches=$root/llvm-backend/patches
  wanted="
    llvm/lib/Target/RISCV
    llvm/lib/TargetParser/RISCVISAInfo.cpp
    llvm/lib/TargetParser/RISCVTargetParser.cpp
    llvm/tools/llc llvm/tools/opt llvm/tools/llvm-mc llvm/tools/llvm-objdump
    llvm/utils/UpdateTestChecks
    llvm/utils/update_llc_test_checks.py
    llvm/utils/update_test_checks.py
    clang/tools/driver
    compiler-rt/lib/builtins
    libclc"
  if [ "$name" = llvm-tests ]; then
    patches= # they are run as they are
    wanted="llvm/test/CodeGen/RISCV llvm/test/MC/RISCV"
  fi
  ;;
pocl)
  package=pocl version=6.0-6 suite=trixie
  files="pocl_6.0.orig.tar.gz:de9710223fc1855f833dbbf42ea2681e06aa8ec0464f0201104dc80a74dfd1f2
    pocl_6.0-6.debian.tar.xz:ea1bb0f0799fecf06c9eab5b13da13d2a0bf5a0cf9a22e8ea008276a7b048d48"
  override=${VORION_POCL_SOURCE:-}
  patches=$root/runtime/pocl/patches
  wanted=""
  ;;
esac

archives=$sources/.archives
pristine=$sources/.pristine/$name
mkdir -p "$archives" "$sources/.pristine"

# One run at a time: two builds may ask for the same sources.
exec 9>"$sources/.lock.${name%%-*}"
flock 9

scratch=
trap '[ -z "$scratch" ] || rm -rf "$scratch"' EXIT

sha256() { sha256sum "$1" | cut -d' ' -f1; }

# --- get the files -----------------------------------------------------------

from_override() { # file -> leaves it in $archives, or fails
  for place in $override; do
    case $place in
    *://*)
      [ "${place##*/}" = "$1" ] || continue
      say "downloading $place"
      /usr/lib/apt/apt-helper download-file "$place" "$archives/$1.part" >&2 ||
        fail 3 "$place: cannot be downloaded"
      ;;
    *)
      [ -d "$place" ] && place=$place/$1
      [ "${place##*/}" = "$1" ] || continue
      [ -f "$place" ] || fail 3 "$place: no such file, expected a file of $package $version"
      cp "$place" "$archives/$1.part"
      ;;
    esac
    mv "$archives/$1.part" "$archives/$1"
    return
  done
  fail 3 "$1: not among the places given in the environment ($override)"
}

from_apt() { # leaves every file of the package in $archives
  say "downloading $package $version through apt"
  scratch=$(mktemp -d)
  chmod 755 "$scratch" # apt's own user must get in
  mkdir -p "$scratch/lists/partial" "$scratch/cache/archives/partial" "$scratch/parts"
  # The mirror is whatever this machine's apt uses for its own release.
  apt-get indextargets --format '$(CODENAME) $(REPO_URI)' 'Created-By: Packages' |
    awk -v suite="$suite" -v release="$release" -v key=/usr/share/keyrings/debian-archive-keyring.gpg '
      $1 == release && !seen[$1]++ { print "deb-src [signed-by=" key "] " $2 " " suite " main" }
      $1 == release "-security" && !seen[$1]++ { print "deb-src [signed-by=" key "] " $2 " " suite "-security main" }
    ' >"$scratch/sources.list"
  [ -s "$scratch/sources.list" ] ||
    fail 3 "apt: no package source of Debian's release $release is configured on this machine"
  # Debian's own part only where we use it.
  part=--tar-only
  case $files in *.debian.tar.xz:*) part= ;; esac
  (
    cd "$archives"
    set -- -o Dir::Etc::sourcelist="$scratch/sources.list" -o Dir::Etc::sourceparts="$scratch/parts" \
      -o Dir::State::Lists="$scratch/lists" -o Dir::Cache="$scratch/cache" \
      -o APT::Get::List-Cleanup=0 -o APT::Sandbox::User=root -o Acquire::Retries=3 -qq
    apt-get "$@" update && apt-get "$@" $part --download-only source "$package=$version"
  ) >&2 || fail 3 "$package $version: apt cannot fetch it; give its files in the environment (see --help)"
}

get_archives() {
  for entry in $files; do
    file=${entry%%:*} hash=${entry##*:}
    if [ ! -f "$archives/$file" ] || [ "$(sha256 "$archives/$file")" != "$hash" ]; then
      rm -f "$archives/$file"
      if [ -n "$override" ]; then from_override "$file"; else from_apt; fi
    fi
    [ -f "$archives/$file" ] || fail 3 "$file: apt did not leave it, expected it in $package $version"
    actual=$(sha256 "$archives/$file")
    [ "$actual" = "$hash" ] || {
      mv "$archives/$file" "$archives/$file.rejected"
      fail 3 "$archives/$file.rejected: sha256 is $actual, expected $hash"
    }
  done
}

# --- unpack ------------------------------------------------------------------

# The backend is linked with the installed archives, so the sources must be theirs. Debian may have built the
# same sources again (1:19.1.7-3+b1).
if [ "$package" = llvm-toolchain-19 ]; then
  installed=$(dpkg-query -W -f '${source:Version}' llvm-19-dev 2>/dev/null || true)
  [ -z "$installed" ] || [ "$installed" = "$version" ] ||
    fail 3 "llvm-19-dev: version $installed is installed, expected $version"
fi

origin=$(echo "$package $version $files $wanted" | sha256sum | cut -d' ' -f1)
if [ "$(cat "$pristine.stamp" 2>/dev/null)" != "$origin" ]; then
  get_archives
  say "unpacking $package $version"
  rm -rf "$pristine" "$pristine.part" "$pristine.stamp"
  mkdir -p "$pristine.part"
  first=${files%%:*}
  if [ -n "$wanted" ]; then
    top=${first%%.orig*}
    for path in $wanted; do echo "$top/$path"; done >"$pristine.list"
    tar -xf "$archives/$first" -C "$pristine.part" --strip-components=1 -T "$pristine.list"
    rm "$pristine.list"
  else
    tar -xf "$archives/$first" -C "$pristine.part" --strip-components=1
  fi
  for entry in $files; do
    case $entry in
    *.debian.tar.xz:*)
      tar -xf "$archives/${entry%%:*}" -C "$pristine.part"
      while read -r patch _; do
        case $patch in '' | '#'*) continue ;; esac
        patch -d "$pristine.part" -p1 -s -f --no-backup-if-mismatch <"$pristine.part/debian/patches/$patch" ||
          fail 4 "debian/patches/$patch: does not apply to $package $version"
      done <"$pristine.part/debian/patches/series"
      ;;
    esac
  done
  mv "$pristine.part" "$pristine"
  echo "$origin" >"$pristine.stamp"
fi

# --- patch -------------------------------------------------------------------

ours= # in the order of the series; scripts/patches.py makes it
[ -z "$patches" ] || ours=$(sed "s,^,$patches/," "$patches/series")
# A patch's header changes nothing.
state=$( { echo "$origin"; for patch in $ours; do sed '1,/^---$/d' "$patch"; done; } | sha256sum | cut -d' ' -f1)
if [ "$(cat "$sources/$name.stamp" 2>/dev/null)" = "$state" ] && [ -d "$sources/$name" ]; then
  exit 0
fi
[ -z "$ours" ] || say "patching $name"
fresh=$sources/$name.part
rm -rf "$fresh" "$sources/$name.stamp"
cp -a "$pristine" "$fresh" # keeps the times, so that only patched files are built again
for patch in $ours; do
  patch -d "$fresh" -p1 -s -f -F0 --no-backup-if-mismatch <"$patch" ||
    fail 4 "$patch: does not apply to $package $version"
  sed -n 's,^+++ b/\([^[:space:]]*\).*,\1,p' "$patch"
done >"$sources/$name.patched"
while read -r file; do
  if cmp -s "$fresh/$file" "$sources/$name/$file"; then
    touch -r "$sources/$name/$file" "$fresh/$file"
  fi
done <"$sources/$name.patched"
rm -f "$sources/$name.patched"
rm -rf "${sources:?}/$name"
mv "$fresh" "$sources/$name"
echo "$state" >"$sources/$name.stamp"
say "$sources/$name is ready"
