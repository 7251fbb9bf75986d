// As in shared-variables.c, for a variable of OpenCL C's local memory.
// REQUIRES: vorion-clang
// RUN: vorion-clang -O2 -Xclang -finclude-default-header -S %s -o - | FileCheck %s

// CHECK-LABEL: told:
// CHECK: sw zero, %lo(told.Value)([[AT:[a-z0-9]+]])
// CHECK: call {{.*}}barrier
// CHECK: call {{.*}}barrier
// CHECK: lw {{.*}}%lo(told.Value)([[AT]])
kernel void told(global int *Out) {
  local int Value;
  Value = 0;
  barrier(CLK_LOCAL_MEM_FENCE);
  if (Out[0] == 7)
    Value = 5;
  barrier(CLK_LOCAL_MEM_FENCE);
  Out[1] = Value;
}
