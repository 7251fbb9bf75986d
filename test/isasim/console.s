# The console shows whole lines, core by core, however the cores take turns.
# REQUIRES: vorion-mc, vorion-sim
# RUN: sh %S/Inputs/assemble.sh %build %s %t.elf
# RUN: vorion-sim %t.elf | FileCheck %s
# RUN: vorion-sim %t.elf --set host_threads=1 > %t.1
# RUN: vorion-sim %t.elf --set host_threads=5 > %t.5
# RUN: diff %t.1 %t.5

# CHECK:      core 0 abcdefghijklmnop{{$}}
# CHECK-NEXT: core 1 abcdefghijklmnop{{$}}
# CHECK-NEXT: core 2 abcdefghijklmnop{{$}}
# CHECK-NEXT: core 3 abcdefghijklmnop{{$}}
# CHECK-NEXT: core 4 abcdefghijklmnop{{$}}
# CHECK-NEXT: core 5 abcdefghijklmnop{{$}}
# CHECK-NEXT: core 6 abcdefghijklmnop{{$}}
# CHECK-NEXT: core 7 abcdefghijklmnop{{$}}
  .globl _start
_start:
  la a0, text
1:
  lbu a1, 0(a0)
  beqz a1, 2f
  sw a1, 0x40(zero)
  addi a0, a0, 1
  j 1b
2:
  csrr a2, vx_core_id
  addi a2, a2, '0'
  sw a2, 0x40(zero)
  li a3, ' '
  sw a3, 0x40(zero)
  # Park in the middle of the line.
  li a4, 0x10000
  amoor.w a4, zero, (a4)
  li t0, -1
  srli t0, t0, 16
  vx_tmc t0
  csrr a4, vx_thread_id
  addi a4, a4, 'a'
  sw a4, 0x40(zero)
  li t0, 1
  vx_tmc t0
  li a5, '\n'
  sw a5, 0x40(zero)
  vx_tmc zero
  .section .rodata
text:
  .asciz "core "
