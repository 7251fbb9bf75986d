# A program in the way of riscv-tests: linked by itself, soft-float, any entry
# point, M-mode harts that begin at once; it prints by tohost commands and by a
# write call, and ends by storing (code << 1) | 1 to tohost.
# REQUIRES: vorion-sim
# DEFINE: %{build} = llvm-mc-19 -triple=riscv32 -mattr=+m -filetype=obj %s -o %t.o
# RUN: %{build} --defsym CODE=0 && ld.lld-19 --defsym=FIRST_ADDRESS=0x80000000 -T %S/Inputs/test-program.ld -e begin %t.o -o %t.pass
# RUN: vorion-sim %t.pass --one-hart | FileCheck %s
# RUN: vorion-sim %t.pass | FileCheck %s
# RUN: %{build} --defsym CODE=7 && ld.lld-19 --defsym=FIRST_ADDRESS=0x80100000 -T %S/Inputs/test-program.ld -e begin %t.o -o %t.fail
# RUN: not vorion-sim %t.fail --one-hart 2>&1 | FileCheck %s --check-prefixes=CHECK,FAIL
# CHECK: HTIF
# CHECK-NEXT: written by a call
# CHECK-NOT: {{.}}
# FAIL: vorion-sim: error: {{.*}}.fail: the program failed with exit code 7{{$}}
  .text
never:
  j never
  .globl begin
begin:
  csrr t0, mhartid
  bnez t0, never          # other cores wait for the first one to end the run
  la s0, text
1:
  lbu a0, 0(s0)
  beqz a0, 2f
  la t0, tohost
  sw a0, 0(t0)            # the payload, then device 1 and command 1
  li t1, 0x01010000
  sw t1, 4(t0)
3:
  lw t1, 0(t0)            # the host takes it
  bnez t1, 3b
  addi s0, s0, 1
  j 1b
2:
  la t0, tohost           # write(1, line, 18)
  la t1, call
  sw t1, 0(t0)
  sw zero, 4(t0)
  la t0, fromhost
4:
  lw t1, 0(t0)
  beqz t1, 4b
  sw zero, 0(t0)
  la t0, call
  lw a0, 0(t0)            # its result
  li a1, 18
  li gp, 99 << 1 | 1
  bne a0, a1, 5f
  li gp, CODE << 1 | 1
5:
  la t0, tohost
  sw gp, 0(t0)
  sw zero, 4(t0)
  j 5b

  .data
  .balign 8
call:
  .dword 64, 1, line, 18
text:
  .asciz "HTIF\n"
line:
  .ascii "written by a call\n"
  .section .tohost, "aw", @progbits
  .balign 64
  .globl tohost, fromhost
tohost:
  .dword 0
  .balign 64
fromhost:
  .dword 0
