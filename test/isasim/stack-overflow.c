// A lane that needs more than its stack gets a report and leaves the other
// lanes' stacks alone.
// REQUIRES: vorion-clang, vorion-link, vorion-sim
// RUN: vorion-clang -O1 %s -o %t.elf
// RUN: not vorion-sim %t.elf --set host_threads=1 2>&1 | FileCheck %s
// CHECK: trap: core 2, warp 0, lane 0: stack overflow
// CHECK-NEXT: <depth
#include <vorion.h>

__attribute__((noinline)) static unsigned depth(volatile unsigned *above,
                                                unsigned n) {
  volatile unsigned here[64];
  for (int i = 0; i < 64; ++i)
    here[i] = n + above[i];
  return n == 0 ? here[5] : depth(here, n - 1) + here[7];
}

int main(void) {
  volatile unsigned first[64];
  for (int i = 0; i < 64; ++i)
    first[i] = 0;
  const unsigned far = vx_core_id() == 2 ? 100000 : 3;
  return depth(first, far) == 0;
}
