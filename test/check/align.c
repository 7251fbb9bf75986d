// A misaligned access traps; the check says what was there.
// REQUIRES: vorion-clang, vorion-link, vorion-sim
// RUN: vorion-clang -O1 -g %s -o %t.elf
// RUN: not vorion-sim %t.elf --check align 2>&1 | FileCheck %s
// CHECK: vorion-sim: check: align: {{.*}}align.c:[[#@LINE+6]] (main): misaligned load of 4 bytes at 0x{{[0-9a-f]+}}, at {{.*}}+0x2
// CHECK-NEXT: core 0, warp 0, lane 0, pc
// CHECK: vorion-sim: error: {{.*}}: trap: core 0, warp 0, lane 0: misaligned load
volatile unsigned offset = 2;
unsigned char bytes[16] = {1, 2, 3, 4, 5, 6, 7, 8};
int main(void) { // traps
  return *(volatile int *)(bytes + offset);
}
