#!/bin/sh
# commit.sh ROOT CHECKOUT: what cmake/WriteCommit.cmake says of an empty checkout.
set -eu
write() { cmake "-DOUTPUT=$2/out/commit" "-DSOURCE=$3" "-DCOMMIT=$4" -P "$1/cmake/WriteCommit.cmake"; }
mkdir "$2/out"
echo out > "$2/.git/info/exclude"
echo first > "$2/file"
git -C "$2" add file
git -C "$2" -c user.name=t -c user.email=t@example.org commit -q -m first
write "$1" "$2" "$2" ""
echo "clean: $(cat "$2/out/commit")"
echo second > "$2/file"
write "$1" "$2" "$2" ""
echo "changed: $(cat "$2/out/commit")"
write "$1" "$2" "$2/below" ""
echo "below: $(cat "$2/out/commit")"
write "$1" "$2" "$2" 1.2-3
echo "told: $(cat "$2/out/commit")"
touch -d 2001-01-01 "$2/out/commit"
write "$1" "$2" "$2" 1.2-3
echo "written again: $(find "$2/out/commit" -newermt 2001-01-02 | grep -q . && echo yes || echo no)"
