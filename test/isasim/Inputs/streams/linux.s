# A random program as a Linux user program: the log goes to standard output.
  .section .text.vorion_start, "ax", @progbits
  .globl _start, done
_start:
  j run
done:
  la s0, log
  li s1, LOG_BYTES
1:
  li a0, 1
  mv a1, s0
  mv a2, s1
  li a7, 64         # write(1, s0, s1), which may write less
  ecall
  blez a0, 2f
  add s0, s0, a0
  sub s1, s1, a0
  bnez s1, 1b
2:
  snez a0, s1
  li a7, 93         # exit
  ecall
  .org 0x80         # as in vorion.s: both have `run` at the same address
