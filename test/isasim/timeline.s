# The timeline is valid JSON with a row for each warp and rasterizer.
# REQUIRES: vorion-mc, vorion-sim
# RUN: sh %S/Inputs/assemble.sh %build %s %t.elf
# RUN: vorion-sim %t.elf --timeline %t.json --stats %t.stats
# RUN: %python %S/Inputs/timeline.py %t.json | FileCheck %s
# CHECK: cores: 8 rows
# CHECK: rasterizers: 2 rows
# CHECK: runs: 1 rows
# Core 0 counts to 100 and draws a number; the others wait for it at a barrier.
# CHECK: core 0 warp 0: running
# CHECK: core 1 warp 0: running, waits at barrier 0 of the device for 8 cores, running

# The counters of the same run.
# RUN: FileCheck %s --check-prefix=STATS < %t.stats
# STATS: "format": "vorion-stats 1"
# STATS: "lanes_per_warp": 16
# STATS: "parks": 9
# STATS: "name": ""
# STATS: "outcome": "done"
  .globl _start
_start:
  csrr a0, vx_core_id
  bnez a0, 2f
  li t0, 100
1:
  addi t0, t0, -1
  bnez t0, 1b
  li a3, 0x10000
  amoadd.w a4, t0, (a3)
2:
  lui t1, 0x80000
  li t2, 8
  vx_bar t1, t2
  vx_tmc zero
