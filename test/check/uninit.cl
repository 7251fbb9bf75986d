// Local memory that only some work-items have written.
// REQUIRES: vorion-clang, vorion-cl-link, vorion-device, vorion-sim
// RUN: vorion-clang -g %s -o %t.elf
// RUN: not vorion-sim %t.elf --kernel half_written --global 32 --local 16 --arg out:128@%t.out --check uninit 2>&1 | FileCheck %s
// CHECK: vorion-sim: check: uninit: {{.*}}uninit.cl:[[#@LINE+20]] (half_written): store of a value from uninitialized memory at 0x{{[0-9a-f]+}}, {{[0-9]+}} bytes into buffer 'out' (128 bytes at 0x{{[0-9a-f]+}})
// CHECK-NEXT: core 0, warp 0, lane 0,
// CHECK-NOT: uninit:

// A branch on what was never set.
// RUN: not vorion-sim %t.elf --kernel decide --global 16 --arg buf:64 --check uninit 2>&1 | FileCheck %s --check-prefix=BRANCH
// BRANCH: vorion-sim: check: uninit: {{.*}}uninit.cl:[[#@LINE+22]] (decide): {{condition|branch on a value}} from uninitialized memory (lanes 0xfffe)

// A structure is copied with the bytes between its members, which nobody writes.
// RUN: vorion-sim %t.elf --kernel copy --global 2 --local 2 --arg out:12@%t.out --arg local:12 --check uninit
// A member that nobody wrote is one all the same, if it is a word.
// RUN: not vorion-sim %t.elf --kernel copy_without --global 2 --local 2 --arg out:12@%t.out --arg local:12 --check uninit 2>&1 | FileCheck %s --check-prefix=MEMBER
// MEMBER: vorion-sim: check: uninit: {{.*}} (copy_without): store of a value from uninitialized memory at 0x{{[0-9a-f]+}}, 4 bytes into buffer 'output'

kernel void half_written(global int *out) {
  local int shared[16];
  int i = get_local_id(0);
  if (i < 8)
    shared[i] = i;
  barrier(CLK_LOCAL_MEM_FENCE);
  out[get_global_id(0)] = shared[15 - i];
}

kernel void decide(global int *out) {
  local int limit[4];
  int i = get_global_id(0);
  if (out[i] == 7) // never
    limit[i % 4] = i;
  if (limit[i % 4] > i)
    for (int k = 0; k < i; ++k)
      out[k] = out[k] * 3 + 1;
}

struct padded {
  char a;
  int b;
  char c;
};

kernel void copy(global struct padded *output, local struct padded *shared) {
  if (get_local_id(0) == 0) {
    shared->a = 1;
    shared->b = 2;
    shared->c = 3;
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  if (get_local_id(0) == 1)
    *output = *shared;
}

kernel void copy_without(global struct padded *output, local struct padded *shared) {
  if (get_local_id(0) == 0) {
    shared->a = 1;
    shared->c = 3;
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  if (get_local_id(0) == 1)
    *output = *shared;
}
