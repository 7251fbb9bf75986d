// With -g the simulator's faults and vorion-objdump -S show the source, at
// every level; without, the function's name remains.
// REQUIRES: vorion-clang, vorion-link, vorion-sim, vorion-objdump
// RUN: vorion-clang -g -O0 %s -o %t.O0.elf && not vorion-sim %t.O0.elf 2>&1 | FileCheck %s
// RUN: vorion-clang -g -O2 %s -o %t.O2.elf && not vorion-sim %t.O2.elf 2>&1 | FileCheck %s --check-prefixes=CHECK,INLINED
// RUN: vorion-clang -gline-tables-only -Os %s -o %t.Os.elf && not vorion-sim %t.Os.elf 2>&1 | FileCheck %s --check-prefixes=CHECK
// RUN: vorion-objdump -S %t.O2.elf | FileCheck %s --check-prefix=SOURCE
// RUN: vorion-objdump -d -l %t.O2.elf | FileCheck %s --check-prefix=LINES
// RUN: vorion-clang -O2 %s -o %t.none.elf && not vorion-sim %t.none.elf 2>&1 | FileCheck %s --check-prefix=NONE --implicit-check-not=source
#include <vorion.h>

// The address is below all memory, however much the machine has.
// CHECK: load access fault
// CHECK-NEXT: pc 0x
// CHECK-NEXT: source {{.*}}lines.c:[[#@LINE+5]] in far_away
// INLINED-NEXT: called from {{.*}}lines.c:[[#@LINE+9]] in fault
// SOURCE: ;   return p[i - (uint)p / 4];
// LINES: lines.c:[[#@LINE+2]]{{$}}
static float far_away(const float *p, uint i) {
  return p[i - (uint)p / 4];
}
__attribute__((noinline)) static void fault(float *p) {
  const uint i = vx_thread_id();
  if (i > 2)
    p[i] = far_away(p, i) + 1.0f;
}
// NONE: pc 0x{{.*}} <fault+{{.*}}>
// NONE-NEXT: active lanes

static float numbers[99];
int main(void) {
  fault(numbers);
  return 0;
}
