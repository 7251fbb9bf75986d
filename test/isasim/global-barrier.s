# Cores meet at a barrier of the device three times: what each wrote before it
# is what its neighbour reads after it.
# REQUIRES: vorion-mc, vorion-sim
# RUN: sh %S/Inputs/assemble.sh %build %s %t.elf
# RUN: vorion-sim %t.elf --set host_threads=1
# RUN: vorion-sim %t.elf --set host_threads=3
  .globl _start
_start:
  csrr s0, vx_core_id
  csrr s1, vx_num_cores
  li s2, 0x10000          # words by core
  sh2add s3, s0, s2       # my word
  addi s4, s0, 1
  remu s4, s4, s1
  sh2add s4, s4, s2       # my neighbour's
  li s5, 3
round:
  sw s5, 0(s3)
  # Unequal work, so that cores arrive at different times.
  slli t0, s0, 8
1:
  addi t0, t0, -1
  bgtz t0, 1b
  li a0, 0x80000002
  vx_bar a0, s1
  lw t1, 0(s4)
  xor t1, t1, s5
  sw t1, 0x44(zero)       # not 0: a failure
  vx_bar a0, s1
  addi s5, s5, -1
  bnez s5, round
  vx_tmc zero
