// One element too many: named with its buffer, line and lane.
// REQUIRES: vorion-clang, vorion-cl-link, vorion-device, vorion-sim
// RUN: vorion-clang -g %s -o %t.elf
// RUN: not vorion-sim %t.elf --global 64 --local 16 --arg buf:256 --arg out:256@%t.out --check bounds 2>&1 | FileCheck %s
// CHECK: vorion-sim: check: bounds: {{.*}}bounds.cl:[[#@LINE+9]] (shift): load of 4 bytes at 0x{{[0-9a-f]+}}, 0 bytes past the end of buffer 'in' (256 bytes at 0x00010000)
// CHECK-NEXT: core 3, warp 0, lane 15, pc 0x{{[0-9a-f]+}} <shift+0x{{[0-9a-f]+}}>: lw {{.*}}
// CHECK-NOT: bounds
// Without the check it goes unnoticed; a far one traps, and the check names it.
// RUN: vorion-sim %t.elf --global 64 --local 16 --arg buf:256 --arg out:256@%t.out
// RUN: not vorion-sim %t.elf --global 64 --local 16 --arg buf:252 --arg out:256@%t.out --check bounds 2>&1 | FileCheck %s --check-prefix=TWO
// TWO: check: bounds: {{.*}} 0 bytes past the end of buffer 'in' (252 bytes
kernel void shift(global const int *in, global int *out) {
  int i = get_global_id(0);
  out[i] = in[i + 1];
}
