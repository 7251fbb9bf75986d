// A program with main() has stacks as large as its functions need, on all
// lanes of all cores, and no lane reaches the stack of another.
// REQUIRES: vorion-clang, vorion-link, vorion-sim
// RUN: vorion-clang -O2 %s -o %t.elf
// RUN: vorion-sim %t.elf
// RUN: vorion-sim %t.elf --set engine=interpreter
// RUN: vorion-sim %t.elf --set engine=translator,lanes_per_warp=5
// RUN: vorion-clang -O2 -DBEYOND=27500 %s -o %t.up.elf
// RUN: not vorion-sim %t.up.elf 2>&1 | FileCheck %s
// RUN: vorion-clang -O2 -DBEYOND=-60000 %s -o %t.down.elf
// RUN: not vorion-sim %t.down.elf 2>&1 | FileCheck %s
// CHECK: trap: core 0, warp 0, lane {{[0-9]+}}: stack overflow
#include <vorion.h>

enum { WORDS = 20000, STEP = 99 };

static uint value(uint i) { return i * 7 + vx_thread_id() + 16 * vx_core_id(); }

__attribute__((noinline)) static uint fill_and_count(uint *a) {
  uint b[WORDS], bad = 0;
  for (uint i = 0; i < WORDS; i += STEP)
    a[i] = b[WORDS - 1 - i] = value(i);
  __asm__ volatile("" : : "r"(a), "r"(b) : "memory");
  for (uint i = 0; i < WORDS; i += STEP)
    bad += (a[i] != value(i)) + (b[WORDS - 1 - i] != value(i));
  return bad;
}

int main(void) {
  uint a[WORDS];
#ifdef BEYOND
  ((volatile uint *)a)[BEYOND + (int)vx_num_warps()] = 1;
#endif
  return fill_and_count(a) != 0;
}
