# The trace has a line for each warp instruction, and changes nothing.
# REQUIRES: vorion-mc, vorion-sim
# RUN: sh %S/Inputs/assemble.sh %build %s %t.elf
# RUN: vorion-sim %t.elf --trace 2> %t.trace | FileCheck %s --check-prefix=OUT
# OUT: x
# RUN: FileCheck %s < %t.trace
# CHECK: 0.0 0x80000000 <_start> 0001 csrrs a0, vx_core_id, zero -> 00000000
# CHECK-NEXT: 0.0 0x80000004 <_start+0x4> 0001 bne a0, zero, 0x{{[0-9a-f]+}}
# CHECK-NEXT: 0.0 {{.*}} 0001 addi t0, zero, 5 -> 00000005
# CHECK-NEXT: 0.0 {{.*}} 0001 vx_tmc t0
# CHECK-NEXT: 0.0 {{.*}} 0005 csrrs a1, vx_thread_id, zero -> 00000000 00000002
# CHECK-NEXT: 0.0 {{.*}} 0005 addi a2, zero, 120 -> 00000078
# CHECK-NEXT: 0.0 {{.*}} 0005 sw a2, 64(zero)
# CHECK-NEXT: 0.0 {{.*}} 0005 lui a3, 16 -> 00010000
# The atomic waits until all cores have stopped.
# CHECK: 0.0 {{.*}} 0005 amoadd.w a4, a1, (a3) -> 00000000
# CHECK-NEXT: 0.0 {{.*}} 0005 vx_tmc zero
  .globl _start
_start:
  csrr a0, vx_core_id
  bnez a0, 1f
  li t0, 5
  vx_tmc t0
  csrr a1, vx_thread_id
  li a2, 'x'
  sw a2, 0x40(zero)
  li a3, 0x10000
  amoadd.w a4, a1, (a3)
1:
  vx_tmc zero
