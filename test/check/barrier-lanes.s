# A barrier that half of a warp's lanes arrive at.
# REQUIRES: vorion-mc, vorion-sim
# RUN: sh %S/../isasim/Inputs/assemble.sh %build %s %t.elf
# RUN: not vorion-sim %t.elf --check barrier 2>&1 | FileCheck %s
# CHECK: vorion-sim: check: barrier: _start+0x{{[0-9a-f]+}}: barrier reached by lanes 0x00ff, not by lanes 0xff00 of the same warp
# CHECK-NEXT: core 0, warp 0, lane 0, pc 0x{{[0-9a-f]+}} <_start+0x{{[0-9a-f]+}}>: vx_bar t2, t3
# CHECK-NEXT: check: 8 findings at 1 place;
# CHECK: trap: core 0, warp 0, lane 7: barrier that not all lanes of the warp have reached
  .globl _start
_start:
  li t0, -1
  vx_tmc t0
  csrr t1, vx_thread_id
  sltiu t1, t1, 8
  li t2, 0
  li t3, 1
  vx_split t4, t1
  vx_bar t2, t3
  vx_join t4
  vx_tmc zero
