#!/bin/sh
# Run on each finished package: writes its control part anew with the size that it has installed (cpack's counts what
# symbolic links point to) and with the times and owners of SOURCE_DATE_EPOCH. usage: seal.sh PACKAGE
set -eu
package=$(realpath "$1")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
ar x "$package"
mkdir control
tar -xzf control.tar.gz -C control
size=$(dpkg-deb -c "$package" | awk '{ kib += /^-/ ? int(($3 + 1023) / 1024) : 1 } END { print kib }')
sed -i "s/^Installed-Size:.*/Installed-Size: $size/" control/control
tar --sort=name --mtime="@$SOURCE_DATE_EPOCH" --owner=0 --group=0 --numeric-owner -C control -cf - . |
  gzip -9n >control.tar.gz
rm "$package"
ar rcSD "$package" debian-binary control.tar.gz data.tar.*
