# usage: assemble.sh BUILD SOURCE OUTPUT [ASSEMBLER_OPTION]: one assembly file, linked as programs
# for the device are, without their library.
set -e
"$1/bin/vorion-mc" -triple=riscv32 -mattr=+m,+a,+f,+zicond,+zacas,+zba,+zbb,+zbs,+xvortex,+xvorion \
  -target-abi=ilp32f -filetype=obj "$2" -o "$3.o" $4
cat "$1/intrinsics/generated/vorion_numbers.ld" "$(dirname "$0")/../../../libdevice/start/vorion.ld" > "$3.ld"
ld.lld-19 -T "$3.ld" "$3.o" -o "$3"
