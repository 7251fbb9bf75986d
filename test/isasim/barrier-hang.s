# A barrier that not all cores reach.
# REQUIRES: vorion-mc, vorion-sim
# RUN: sh %S/Inputs/assemble.sh %build %s %t.elf
# RUN: sh -c 'vorion-sim %t.elf 2> %t.err; echo "exit $?" >> %t.err'
# RUN: FileCheck %s < %t.err
# CHECK: vorion-sim: error: {{.*}}.elf: hang: all warps wait for each other
# CHECK-NEXT: core.warp 0.0 1.0 2.0 3.0 4.0 5.0 6.0: waits at barrier 1 of the device for 8 cores
# CHECK-NEXT: pc 0x{{[0-9a-f]+}} <_start{{.*}}>: vx_bar a1, a2, active lanes 0x0001
# CHECK-NEXT: exit 5
  .globl _start
_start:
  csrr a0, vx_core_id
  li a1, 7
  beq a0, a1, 1f
  li a1, 0x80000001
  li a2, 8
  vx_bar a1, a2
1:
  vx_tmc zero
