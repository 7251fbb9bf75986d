# Start of a whole kernel that runs alike here and on Vortex's RTL: every warp
# of the core turns all lanes on and calls main; the run ends with the warps.
# Lanes have stacks of 64 KiB, as docs/abi.md places them for one warp.
  .section .text.vorion_start, "ax", @progbits
  .globl _start
_start:
  csrr t0, vx_num_warps
  li t1, 1
  beq t0, t1, 1f
  la t1, 1f
  vx_wspawn t0, t1
1:
  li t0, -1
  vx_tmc t0
  csrr t0, vx_warp_id
  slli t0, t0, 4
  csrr t1, vx_thread_id
  add t0, t0, t1
  slli t0, t0, 16
  li sp, 0xffff0000
  sub sp, sp, t0
  call main
  vx_tmc zero
