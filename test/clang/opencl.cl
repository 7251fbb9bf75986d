// vorion.h in OpenCL C, and in the form PoCL's front end leaves a kernel in:
// bitcode of a plain RISC-V target, which is compiled for our machine all the same.
// REQUIRES: vorion-clang
// RUN: vorion-clang -O2 -I %include -S %s -o - | FileCheck %s
// RUN: clang-19 --target=riscv32-unknown-elf -march=rv32imaf -mabi=ilp32f -O0 -I %include -c -emit-llvm %s -o %t.bc
// RUN: vorion-clang -O2 -S %t.bc -o - | FileCheck %s
#include "vorion.h"

// CHECK: .attribute 5, "{{.*}}xvorion1p0_xvortex2p0"
// CHECK-LABEL: lanes:
// CHECK: vx_split
// CHECK: sh2add
// CHECK: vx_join
void lanes(__global uint *p, uint n) {
  uint i = vx_thread_id();
  if (i < n)
    p[i] = vr_status();
}
