// The optimiser leaves the rasterizer's accesses where they are among memory
// accesses: descriptors are stored before the start, results loaded after the wait.
// REQUIRES: vorion-clang
// RUN: vorion-clang -O3 -I %include -S %s -o - | FileCheck %s
// RUN: vorion-clang -O3 -I %include -S -emit-llvm %s -o - | FileCheck --check-prefix=IR %s
#include "vorion.h"

// CHECK-LABEL: draw:
// CHECK-DAG: sw {{.*}}, 20(a0)
// CHECK-DAG: sw {{.*}}, 0(a1)
// CHECK-DAG: csrw vr_count
// CHECK: csrw vr_start, zero
// CHECK: csrr {{a[0-9]}}, vr_wait
// CHECK: lw {{a[0-9]}}, 0(a2)
// CHECK: ret
uint draw(vx_gaussian *g, uint *list, const uint *result) {
  g->opacity = 0.5f;
  list[0] = 7;
  vr_count_set(1);
  vr_start_set(0);
  uint code = vr_wait();
  return result[0] + code;
}

// A load does not move across a wait, nor is it done once for two.
// CHECK-LABEL: twice:
// CHECK: lw
// CHECK: csrr {{.*}}, vr_wait
// CHECK: lw
// CHECK: ret
uint twice(const uint *result) {
  uint before = result[0];
  (void)vr_wait();
  return before ^ result[0];
}

// Two reads of the status are two reads; a loop asks each time.
// CHECK-LABEL: poll:
// CHECK: [[LOOP:.LBB[0-9_]+]]:
// CHECK: csrr {{.*}}, vr_status
// CHECK: bnez {{.*}}, [[LOOP]]
void poll(void) {
  while (vr_status() & VR_STATUS_BUSY_MASK)
    ;
}

// A vote stays on its side of a condition: other lanes take part in each. (The
// code of the two may be one, which is executed for each side of the split.)
// CHECK-LABEL: votes:
// CHECK: vx_split
// CHECK: vx_vote_any
// CHECK: vx_join
// IR-LABEL: @votes(
// IR: br i1
// IR: call i32 @vorion.vx_vote_any
// IR: call i32 @vorion.vx_vote_any
uint votes(uint a, uint b) {
  if (a)
    return vx_vote_any(b);
  return vx_vote_any(b);
}
