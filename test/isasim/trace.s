# The trace has lines of the categories that were asked for, and changes nothing.
# REQUIRES: vorion-mc, vorion-sim
# RUN: sh %S/Inputs/assemble.sh %build %s %t.elf
# RUN: vorion-sim %t.elf --trace insn,mem:%t.trace | FileCheck %s --check-prefix=OUT
# OUT: x
# RUN: FileCheck %s < %t.trace
# CHECK: # vorion-trace 1
# CHECK-NEXT: run 1 {{.*}} launch 0x00000000
# CHECK-NEXT: insn 0.0 0x80000000 <_start> 0001 csrrs a0, vx_core_id, zero -> 00000000
# CHECK-NEXT: insn 0.0 0x80000004 <_start+0x4> 0001 bne a0, zero, 0x{{[0-9a-f]+}}
# CHECK-NEXT: insn 0.0 {{.*}} 0001 addi t0, zero, 5 -> 00000005
# CHECK-NEXT: insn 0.0 {{.*}} 0001 vx_tmc t0
# CHECK-NEXT: insn 0.0 {{.*}} 0005 csrrs a1, vx_thread_id, zero -> 00000000 00000002
# CHECK-NEXT: insn 0.0 {{.*}} 0005 addi a2, zero, 120 -> 00000078
# CHECK-NEXT: insn 0.0 {{.*}} 0005 sw a2, 64(zero)
# CHECK-NEXT: mem 0.0 {{.*}} 0005 store 4 00000040
# CHECK-NEXT: insn 0.0 {{.*}} 0005 lui a3, 16 -> 00010000
# The atomic waits until all cores have stopped.
# CHECK: insn 0.0 {{.*}} 0005 amoadd.w a4, a1, (a3) -> 00000000
# CHECK-NEXT: mem 0.0 {{.*}} 0005 atomic 4 00010000
# A pair of registers has both its words.
# CHECK-NEXT: insn 0.0 {{.*}} 0005 addi a7, zero, 3 -> 00000003
# CHECK-NEXT: insn 0.0 {{.*}} 0005 amocas.d a6, zero, (a3) -> 00000002 -> 00000000
# CHECK-NEXT: mem 0.0 {{.*}} 0005 atomic 8 00010000
# CHECK-NEXT: insn 0.0 {{.*}} 0005 vx_tmc zero
# CHECK: end done exit 0 instructions {{[0-9]+}}

# Without a file it goes to stderr.
# RUN: vorion-sim %t.elf --trace sync,simt 2>&1 | FileCheck %s --check-prefix=SYNC
# SYNC: simt 0.0 {{.*}} 0001 vx_tmc t0
# SYNC-NOT: insn
# SYNC: sync 1
# SYNC-NEXT: sync 0.0 0x{{[0-9a-f]+}} at an atomic
# RUN: not vorion-sim %t.elf --trace insn,what 2>&1 | FileCheck %s --check-prefix=WHAT
# WHAT: vorion-sim: error: trace category 'what', expected all or some of insn,mem,simt,sync,raster,trap, followed by :FILE
# RUN: not vorion-sim %t.elf --trace insn:/none/x 2>&1 | FileCheck %s --check-prefix=FILE
# FILE: vorion-sim: error: /none/x: cannot write: No such file or directory, expected a folder that can be written
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
  li a7, 3
  amocas.d a6, zero, (a3)
1:
  vx_tmc zero
