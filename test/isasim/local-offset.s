# vx_local_offset: a warp's part of local memory begins there. What lies in
# front of it is out of reach, the rest of the core's is at the same addresses.
# REQUIRES: vorion-mc, vorion-sim
# RUN: sh %S/Inputs/assemble.sh %build %s %t.elf
# RUN: echo '{"warps_per_core": 2, "local_bytes": 8192}' > %t.json
# RUN: vorion-sim %t.elf --config %t.json
# RUN: not vorion-sim %t.elf --config %t.json --set local_bytes=4096 2>&1 | FileCheck %s
# CHECK: trap: core 0, warp 1, lane 0: load access fault at 0xffff1000
  .globl _start
_start:
  li s0, 0xffff0000
  csrr s1, vx_warp_id
  csrr t0, vx_local_offset
  bnez t0, wrong
  # Bits 6 to 0 are 0, and what lies behind local memory begins anew.
  li t0, 8192 + 130
  csrw vx_local_offset, t0
  csrr t1, vx_local_offset
  li t2, 128
  bne t1, t2, wrong
  csrw vx_local_offset, zero
  li t0, 17
  sw t0, 1024(s0)
  la t1, second
  li t0, 2
  vx_wspawn t0, t1
meet:
  li t0, 0
  li t1, 2
  vx_bar t0, t1
  # The core's and the second warp's word are one.
  lw t0, 1028(s0)
  li t1, 18
  bne t0, t1, wrong
  vx_tmc zero
second:
  li s0, 0xffff0000
  li t0, 1024
  csrw vx_local_offset, t0
  lw t1, 0(s0)
  li t2, 17
  bne t1, t2, wrong
  li t2, 18
  sw t2, 4(s0)
  # The last word of 8 KiB, and the first behind 4 KiB.
  lui t3, 0xffff1
  lw t4, 0(t3)
  li t0, 0
  li t1, 2
  vx_bar t0, t1
  vx_tmc zero
wrong:
  li t0, 1
  sw t0, 0x44(zero)
  vx_tmc zero
