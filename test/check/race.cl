// A barrier is missing between the stores and the loads.
// REQUIRES: vorion-clang, vorion-cl-link, vorion-device, vorion-sim
// RUN: vorion-clang -g %s -o %t.elf
// RUN: not vorion-sim %t.elf --kernel reverse --global 16 --local 16 --arg inout:%s@%t.out --check race 2>&1 | FileCheck %s
// CHECK: vorion-sim: check: race: {{.*}}race.cl:[[#@LINE+17]] (reverse): load at 0xffff{{[0-9a-f]+}}, {{.*}} is not ordered with the store by core 0, warp 0, lane {{[0-9]+}} of the same group at {{.*}}race.cl:[[#@LINE+16]] (reverse)
// CHECK-NOT: check: race

// Groups of different cores count in one word without an atomic.
// RUN: not vorion-sim %t.elf --kernel count --global 64 --local 16 --arg buf:64 --check race 2>&1 | FileCheck %s --check-prefix=COUNT
// COUNT: vorion-sim: check: race: {{.*}}race.cl:[[#@LINE+17]] (count): {{load|store}} at 0x00010000, 0 bytes into buffer 'sum' (64 bytes at 0x00010000), is not ordered with the {{load|store}} by core {{[0-9]}}, warp 0, lane

// With the barrier, and with an atomic, all is well.
// RUN: vorion-sim %t.elf --kernel reverse_right --global 64 --local 16 --arg inout:%s@%t.out --check race
// RUN: vorion-sim %t.elf --kernel count_right --global 64 --local 16 --arg buf:64 --check race
// So it is where all groups store the same value.
// RUN: vorion-sim %t.elf --kernel groups --global 64 --local 16 --arg buf:64 --check race

kernel void reverse(global int *data) {
  local int shared[16];
  int i = get_local_id(0);
  shared[i] = data[i];
  data[i] = shared[15 - i];
}

kernel void count(global int *sum) {
  if (get_local_id(0) == 0)
    sum[0] += (int)get_group_id(0);
}

kernel void reverse_right(global int *data) {
  local int shared[16];
  int i = get_local_id(0), start = get_group_id(0) * 16;
  shared[i] = data[start + i];
  barrier(CLK_LOCAL_MEM_FENCE);
  data[start + i] = shared[15 - i];
}

kernel void count_right(global int *sum) {
  if (get_local_id(0) == 0)
    atomic_add(sum, (int)get_group_id(0));
}

kernel void groups(global int *number) { *number = get_num_groups(0); }
