# The first non-zero value in the exit word fails the run.
# REQUIRES: vorion-mc, vorion-sim
# RUN: sh %S/Inputs/assemble.sh %build %s %t.elf
# RUN: not vorion-sim %t.elf 2>&1 | FileCheck %s
# CHECK: vorion-sim: error: {{.*}}.elf: the program failed with exit code 42{{$}}
  .globl _start
_start:
  csrr a0, vx_core_id
  li a1, 3
  bne a0, a1, 1f
  li a0, 42
  sw a0, 0x44(zero)
1:
  sw zero, 0x44(zero)
  vx_tmc zero
