#!/usr/bin/env bash
# Whether a build depends on where and when it is made: builds the last commit
# with the preset `release` in two folders, one after the other, and compares
# every object, archive, library and program bit by bit.
# usage: scripts/same-bits.sh NEW_FOLDER [TARGET...]   (default: everything; kept
# afterwards, to look into. VORION_COMPONENTS chooses components, as for CMake)
source "$(dirname "$0")/lib.sh"
showHelp "$@"
Folder=${1:-}
[ -n "$Folder" ] || fail "no folder given, expected: same-bits.sh NEW_FOLDER [TARGET...]"
[ -e "$Folder" ] && fail "$Folder exists, expected the name of a new folder"
shift
readJobs # before the folder is made: a later run would refuse it
mkdir -p "$Folder"
Folder=$(cd "$Folder" && pwd)
Commit=$(git -C "$Root" rev-parse HEAD) # the second copy is made an hour later

# A kept object would be compared with itself.
export CCACHE_DISABLE=1
for Copy in first a-second-one-with-a-longer-name; do
  mkdir "$Folder/$Copy"
  git -C "$Root" archive "$Commit" | tar -x -C "$Folder/$Copy"
  # What was downloaded for this checkout is unpacked and patched for each.
  mkdir -p "$Folder/$Copy/build/sources"
  [ ! -d "$Root/build/sources/.archives" ] || cp -r "$Root/build/sources/.archives" "$Folder/$Copy/build/sources/"
  step "configuring in $Copy" "same-bits-configure" cmake --preset release -S "$Folder/$Copy" \
    ${VORION_COMPONENTS:+"-DVORION_COMPONENTS=$VORION_COMPONENTS"} ${VORION_POCL:+"-DVORION_POCL=$VORION_POCL"}
  step "building in $Copy" "same-bits-build" cmake --build "$Folder/$Copy/build/release" -j "$Jobs" \
    ${1:+--target "$@"}
done

cd "$Folder/first/build/release"
Compared=0 Different=0
while read -r File; do
  Compared=$((Compared + 1))
  cmp -s "$File" "$Folder/a-second-one-with-a-longer-name/build/release/$File" ||
    { Different=$((Different + 1)); echo "different: $File"; }
done < <(find . -type f \( -name '*.o' -o -name '*.a' -o -name '*.so' -o -name '*.so.*' -o -name '*.bc' \
  -o -path './bin/*' \) -not -path './CMakeFiles/*' | LC_ALL=C sort)
[ "$Compared" -ne 0 ] || fail "nothing was built, expected something to compare"
echo "$Compared files compared, $Different different"
[ "$Different" -eq 0 ]
