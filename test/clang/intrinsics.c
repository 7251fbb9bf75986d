// Every kind of declaration in vorion.h ends in its instruction.
// REQUIRES: vorion-clang
// RUN: vorion-clang -O2 -I %include -S %s -o - | FileCheck %s
#include "vorion.h"

// CHECK-LABEL: lane:
// CHECK: csrr a0, vx_thread_id
uint lane(void) { return vx_thread_id(); }

// CHECK-LABEL: list:
// CHECK: csrw vr_list, a0
void list(uint address) { vr_list_set(address); }

// CHECK-LABEL: ballot:
// CHECK: vx_vote_ballot a0, a0
uint ballot(uint predicate) { return vx_vote_ballot(predicate); }

// CHECK-LABEL: shuffle:
// CHECK: vx_shfl_idx a0, a0, a1
uint shuffle(uint value, uint control) { return vx_shfl_idx(value, control); }

// CHECK-LABEL: mask:
// CHECK: vx_tmc a0
void mask(uint lanes) { vx_tmc(lanes); }

// CHECK-LABEL: uniform:
// CHECK-NEXT: {{# %bb|ret}}
uint uniform(uint value) { return vx_uniform(value); }

// CHECK-LABEL: launch:
// CHECK: csrr a0, mscratch
uint launch(void) { return vx_mscratch(); }
