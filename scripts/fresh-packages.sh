#!/usr/bin/env bash
# A stranger who has our packages alone: makes them of build/dev, has lintian
# judge them, installs them in a fresh Debian root that has neither this
# repository nor a compiler, and uses them there as a plain user without any
# environment. Needs root, debootstrap and lintian.
# usage: scripts/fresh-packages.sh NEW_FOLDER   (kept afterwards, to look into)
source "$(dirname "$0")/lib.sh"
showHelp "$@"

Machine=${1:-}
[ -n "$Machine" ] || fail "no folder given, expected: fresh-packages.sh NEW_FOLDER"
[ "$(id -u)" -eq 0 ] || fail "not root, and chroot and mount need it"
for Tool in debootstrap lintian; do
  command -v $Tool >/dev/null || fail "$Tool is not installed"
done

step "making the packages" packages cpack --config "$Build/Packages.cmake" -B "$Build/packages"
step "judging them" lintian lintian --tag-display-limit 0 --fail-on error,warning "$Build"/packages/*.deb
makeRoot "$Machine"
cp "$Build"/packages/*.deb "$Machine/root/"

inside() { chroot "$Machine" env -i HOME="${Home:-/root}" PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 \
  DEBIAN_FRONTEND=noninteractive "$@"; }
asUser() { Home=/home/user inside setpriv --reuid=1000 --regid=1000 --clear-groups sh -ec "cd /home/user && $1"; }

step "updating its lists" fresh-update inside apt-get update
step "installing the packages" fresh-install inside apt-get install -y --no-install-recommends \
  $(cd "$Machine" && ls root/*.deb | sed 's,^,/,') clinfo python3-numpy
inside useradd --create-home --uid 1000 user
expect() { # expect TITLE TEXT COMMAND: a user's command, whose output has the text
  local Output
  printf '[%s] %s\n' "$(elapsed)" "$1"
  Output=$(asUser "$3" 2>&1) || fail "$3: $Output"
  grep -qF -- "$2" <<<"$Output" || fail "$3: expected \"$2\" in: $Output"
}
expect "the device" "Device #0: Vorion" "clinfo -l"
expect "a sample" "matches the host" "sample-vecadd"
expect "a scene" "" "splat demo-scene -o scene.ply --cameras cameras.json"
expect "its picture" "" "splat render scene.ply --cameras cameras.json --view front -o front.png && test -s front.png"
expect "Python" "Vorion" "python3 -c 'import vorion; print(vorion.Machine().name)'"
expect "a kernel" "square" \
  "vorion-clang /usr/share/doc/vorion/examples/downstream/kernel.cl -o k.elf && vorion-sim k.elf --list-kernels"
expect "a program in C" "lane 5 of 16" \
  "vorion-clang -O2 /usr/share/doc/vorion/examples/downstream/main.c -o m.elf && vorion-sim m.elf"

step "installing compilers for programs that use ours" fresh-compilers inside apt-get install -y \
  --no-install-recommends g++ cmake make pkg-config
expect "a project with CMake" "square of 63: 3969" "cp -r /usr/share/doc/vorion/examples/downstream . &&
  cmake -S downstream -B built && cmake --build built && built/with-simulator built/main.elf &&
  built/with-driver built/kernel.elf"
expect "a program with pkg-config" "square of 63: 3969" \
  "cc downstream/driver.c \$(pkg-config --cflags --libs vorion-runtime) -o driver && ./driver built/kernel.elf"
step "removing the packages" fresh-purge inside apt-get purge -y vorion vorion-dev vorion-doc
[ -z "$(find "$Machine/usr" "$Machine/etc" -iname '*vorion*' | head -n 1)" ] || fail "files are left behind"
echo "the packages work in a fresh root"
