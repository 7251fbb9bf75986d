# Each fault ends in a report and exit code 4.
# REQUIRES: vorion-mc, vorion-sim
# RUN: sh %S/Inputs/assemble.sh %build %s %t.elf
# RUN: sh -c 'vorion-sim %t.elf 2> %t.err; echo "exit $?" >> %t.err'
# RUN: FileCheck %s < %t.err
# CHECK: vorion-sim: error: {{.*}}.elf: trap: core 2, warp 0, lane 1: divergent branch
# CHECK-NEXT: pc 0x{{[0-9a-f]+}} <culprit+0x4>: beq t0, zero, 0x{{[0-9a-f]+}}
# CHECK-NEXT: a branch without vx_split must be uniform across active lanes
# CHECK-NEXT: active lanes 0xffff
# CHECK-NEXT: exit 4
  .globl _start
_start:
  csrr a0, vx_core_id
  li a1, 2
  bne a0, a1, 1f
  li t0, -1
  srli t0, t0, 16
  vx_tmc t0
culprit:
  csrr t0, vx_thread_id
  beqz t0, 1f     # lane 0 would go, lane 1 is the first that stays
1:
  vx_tmc zero
