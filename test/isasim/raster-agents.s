# Every core draws one tile of its own and waits; the result and the counters
# do not depend on host threads.
# REQUIRES: vorion-mc, vorion-sim
# RUN: sh %S/Inputs/assemble.sh %build %s %t.elf
# RUN: vorion-sim %t.elf --set host_threads=1 --stats %t.1.json | FileCheck %s
# RUN: vorion-sim %t.elf --set host_threads=4 --stats %t.4.json | FileCheck %s
# RUN: grep -v host_ %t.1.json > %t.1.txt
# RUN: grep -v host_ %t.4.json > %t.4.txt
# RUN: diff %t.1.txt %t.4.txt
# What watches the clock changes nothing, and needs no --time.
# RUN: vorion-sim %t.elf --set host_threads=4 --tiles %t.tiles --stats %t.on.json
# RUN: %python %S/Inputs/tiles.py %t.tiles %t.1.json %t.on.json
# CHECK: raster commands 8{{$}}
# CHECK: raster gaussians 8{{$}}
# CHECK: raster fragments 512{{$}}
# CHECK: raster blends 512{{$}}
  .globl _start
_start:
  csrr s0, vx_core_id
  la a0, gaussian
  li a1, 0x10000
  # Rasterizers see global memory only: copy the record there, once a core.
  slli t0, s0, 6
  add a1, a1, t0
  li t1, 12
1:
  lw t2, 0(a0)
  sw t2, 0(a1)
  addi a0, a0, 4
  addi a1, a1, 4
  addi t1, t1, -1
  bnez t1, 1b
  sw zero, 0(a1)        # the list: record 0
  addi a0, a1, -48
  csrw vr_gaussians, a0
  csrw vr_list, a1
  li t0, 1
  csrw vr_count, t0
  li t0, 0x38d1b717     # 1e-4
  csrw vr_cutoff, t0
  li t0, 0x00080008
  csrw vr_tile_shape, t0
  li a2, 0x20000
  slli t0, s0, 10
  add a2, a2, t0
  csrw vr_output, a2
  li t0, 128
  csrw vr_output_pitch, t0
# TAIL: csrw vr_tail_count, t1; li t0, 0x30000; slli t2, s0, 10; add t0, t0, t2; csrw vr_tail_record, t0
  csrw vr_start, zero
  csrr a3, vr_wait
  sw a3, 0x44(zero)
  vx_tmc zero
  .section .rodata
  .balign 16
gaussian:
  .float 4.0, 4.0             # mean
  .float 0.01, 0.0, 0.01      # conic
  .float 0.5                  # opacity
  .float 1.0, 0.5, 0.25       # colour
  .float 100.0, 100.0         # box
  .word 0
