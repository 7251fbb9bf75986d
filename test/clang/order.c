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

// What only reads lanes changes no memory: unused it goes, and of two equal ones
// under one mask one stays.
// CHECK-LABEL: unused:
// CHECK-NOT: vx_shfl_up
// CHECK: ret
uint unused(uint a, uint b) {
  (void)vx_shfl_up(a, b);
  return a;
}

// CHECK-LABEL: equal:
// CHECK-COUNT-1: vx_shfl_up
// CHECK-NOT: vx_shfl_up
// CHECK: ret
uint equal(uint a, uint b) { return vx_shfl_up(a, b) + vx_shfl_up(a, b); }

// CHECK-LABEL: other_mask:
// CHECK: vx_vote_ballot
// CHECK: vx_tmc
// CHECK: vx_vote_ballot
// CHECK: ret
uint other_mask(uint a) {
  uint before = vx_vote_ballot(a);
  vx_tmc(3);
  return before + vx_vote_ballot(a);
}

// Under a condition fewer lanes may answer.
// IR-LABEL: @fewer_lanes(
// IR: call i32 @vorion.vx_vote_ballot
// IR: br i1
// IR: call i32 @vorion.vx_vote_ballot
uint fewer_lanes(uint a, uint b) {
  uint all = vx_vote_ballot(b);
  if (a)
    all += vx_vote_ballot(b);
  return all;
}

// Nor does a vote leave its loop, from which lanes go one after the other.
// IR-LABEL: @each_round(
// IR: phi i32
// IR: call i32 @vorion.vx_vote_ballot
// IR: br i1
uint each_round(uint a, uint n) {
  uint sum = 0;
  for (uint i = 0; i < n; ++i)
    sum ^= vx_vote_ballot(a) + i;
  return sum;
}

// A load that nothing stores to is done once, in front of the loop of votes.
// IR-LABEL: @invariant(
// IR: load i32, ptr %0
// IR-NOT: load i32, ptr %0
// IR: call i32 @vorion.vx_vote_ballot
// IR-NOT: load i32, ptr %0
// IR: {{^}}}
uint invariant(const uint *restrict p, const uint *restrict q, uint n) {
  uint sum = 0;
  for (uint i = 0; i < n; ++i)
    sum += vx_vote_ballot(q[i]) + *p;
  return sum;
}
