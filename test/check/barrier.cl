// A barrier that half of the work-items reach, while the others go to another.
// REQUIRES: vorion-clang, vorion-cl-link, vorion-device, vorion-sim
// RUN: vorion-clang -g %s -o %t.elf
// RUN: not vorion-sim %t.elf --global 16 --local 16 --arg buf:64 --check barrier 2>&1 | FileCheck %s
// CHECK: vorion-sim: check: barrier: {{.*}}barrier.cl:{{[0-9]+}} (half_of_them): lanes {{[0-9]+}} and 0 diverge at a branch that must be uniform: a barrier depends on it
// CHECK: trap: core 0, warp 0, lane {{[0-9]+}}: divergent branch
// CHECK: a branch without vx_split must be uniform across active lanes; in a kernel, a barrier depends on it
kernel void half_of_them(global int *data) {
  local int shared[16];
  int i = get_local_id(0);
  shared[i] = data[i];
  if (i < 8)
    barrier(CLK_LOCAL_MEM_FENCE);
  data[i] = shared[15 - i];
  barrier(CLK_GLOBAL_MEM_FENCE);
  data[i] += data[15 - i];
}
