# A spin lock between the lanes of one warp: lane 0 has it and waits for the
# others at the loop's end (docs/decisions.md, 4). The report says where.
# REQUIRES: vorion-mc, vorion-sim
# RUN: sh %S/Inputs/assemble.sh %build %s %t.elf
# RUN: sh -c 'vorion-sim %t.elf 2> %t.err; echo "exit $?" >> %t.err'
# RUN: FileCheck %s < %t.err
# CHECK: vorion-sim: error: {{.*}}.elf: hang: no warp can make progress
# CHECK-NEXT: core.warp 0.0: {{running|at an atomic}}
# CHECK-NEXT: pc 0x{{[0-9a-f]+}} <{{take|lock}}{{.*}}>: {{.*}}, active lanes 0xfffe
# CHECK: exit 5
  .globl _start
_start:
  csrr a0, vx_core_id
  bnez a0, end
  li t0, -1
  srli t0, t0, 16
  vx_tmc t0
  li a1, 0x10000
  li a2, 1
lock:
  csrr a4, vx_active_threads
take:
  li a3, 0
  amocas.w a3, a2, (a1)
  vx_pred a3, a4
  vx_vote_any a5, a3
  bnez a5, take
  amoswap.w zero, zero, (a1)
end:
  vx_tmc zero
