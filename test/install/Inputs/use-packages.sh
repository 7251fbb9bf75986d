# Unpacks the packages of a folder into another and uses them from there, with no environment but the folder's own
# loader's file. usage: sh use-packages.sh PACKAGES NEW_FOLDER
set -eu
packages=$1 root=$2
here=$(dirname "$0")/downstream
for package in "$packages"/*.deb; do
  dpkg-deb -x "$package" "$root"
done
# What the package depends on lies where the system has it.
ln -s /usr/lib/llvm-19 "$root/usr/lib/llvm-19"
mkdir "$root/vendors" "$root/home" "$root/pc"
echo "$root$(cat "$root/etc/OpenCL/vendors/vorion.icd")" >"$root/vendors/vorion.icd"
sed "s,^prefix=.*,prefix=$root/usr/lib/vorion," "$root"/usr/lib/*/pkgconfig/vorion-runtime.pc >"$root/pc/vorion-runtime.pc"
cp "$here"/* "$root/home"
cp -r "$root/usr/share/doc/vorion/examples/samples" "$root/home"
# How the samples' README compiles one of them.
sed -n "s,/usr/lib/vorion,$root&,; /^    g++/,/^$/p" "$root/home/samples/README.md" >"$root/home/samples/compile"
cd "$root/home"
env -i HOME="$root/home" PATH="$root/usr/bin:/usr/bin:/bin" OCL_ICD_VENDORS="$root/vendors" \
  PYTHONPATH="$root/usr/lib/python3/dist-packages" PKG_CONFIG_PATH="$root/pc" sh -euc '
    clinfo -l
    sample-vecadd
    splat demo-scene --gaussians 1000 -o scene.ply --cameras cameras.json
    splat render scene.ply --cameras cameras.json --view front -o front.png
    test -s front.png
    /usr/bin/python3 -c "import vorion; print(vorion.Machine().name, vorion.__file__)"
    (cd samples && sh -e compile)
    vorion-clang kernel.cl -o kernel.elf
    vorion-clang main.c -O2 -o main.elf
    vorion-sim main.elf
    clang-19 driver.c $(pkg-config --cflags --libs vorion-runtime) -o driver
    ./driver kernel.elf'
