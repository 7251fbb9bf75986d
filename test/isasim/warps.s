# Several warps a core: spawned, given lanes, met at a barrier of the core.
# REQUIRES: vorion-mc, vorion-sim
# RUN: sh %S/Inputs/assemble.sh %build %s %t.elf
# RUN: echo '{"warps_per_core": 4}' > %t.json
# RUN: vorion-sim %t.elf --config %t.json --set host_threads=1
# RUN: vorion-sim %t.elf --config %t.json --set host_threads=3
  .globl _start
_start:
  csrr a0, vx_num_warps
  la a1, work
  vx_wspawn a0, a1
  la a2, work
  jr a2
work:
  li t0, -1
  srli t0, t0, 16
  vx_tmc t0
  # local[warp * 16 + lane] = hart number
  csrr t1, vx_warp_id
  csrr t2, vx_thread_id
  slli t3, t1, 4
  add t3, t3, t2
  li s0, 0xffff0000
  sh2add t4, t3, s0
  csrr t5, mhartid
  sw t5, 0(t4)
  csrr s1, vx_num_warps
  li s2, 3
  vx_bar s2, s1
  # Each warp reads what the warp after it wrote.
  addi t1, t1, 1
  remu t1, t1, s1
  slli t3, t1, 4
  add t3, t3, t2
  sh2add t4, t3, s0
  lw a0, 0(t4)
  csrr a1, vx_core_id
  slli a1, a1, 6
  add a1, a1, t3
  xor a0, a0, a1
  sw a0, 0x44(zero)
  vx_tmc zero
