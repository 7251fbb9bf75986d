# The clock of vorion-sim: 1025 instructions of a cycle, 9 taken branches, 6 cycles
# of start; and
# docs/tables/timing.md has the parameters that there are.
# REQUIRES: vorion-mc, vorion-sim
# RUN: vorion-sim --print-timing-parameters > %t.made
# RUN: sed -n '/begin of what is made/,/end of what is made/{//!p}' %S/../../docs/tables/timing.md > %t.kept
# RUN: cmp %t.made %t.kept
# RUN: sh %S/Inputs/assemble.sh %build %s %t.elf
# RUN: vorion-sim %t.elf --time --config prototype-on-chip --clock 100 --stats %t.json | FileCheck %s
# RUN: %python -c 'import json,sys; t = json.load(open(sys.argv[1]))["runs"][0]["time"]; assert t["cycles"] == 1049, t["cycles"]; assert t["clock_mhz"] == 100' %t.json
# RUN: vorion-sim %t.elf --time --set timing.l2.ways=4 | FileCheck %s --check-prefix=CHANGED
# RUN: vorion-sim %t.elf --time --set lanes=32,l2.ways=8,l2.kib=512 2>&1 | FileCheck %s --check-prefix=IDLE --implicit-check-not=note:
# IDLE: vorion-sim: note: timing.raster.lanes=32 has no effect on cycles of renders: timing.raster.banks is 16{{$}}
# IDLE: vorion-sim: note: timing.l2.ways=8 has no effect: it is the machine's value{{$}}
# RUN: vorion-sim %t.elf --set l2.kib=512 2>&1 | FileCheck %s --check-prefix=OFF
# OFF: vorion-sim: note: timing.l2.kib=512 has no effect on cycles: timing.enabled is 0{{$}}
# RUN: not vorion-sim %t.elf --time --clock 0 2>&1 | FileCheck %s --check-prefix=WRONG
# CHECK: cycles 1049 (0.010 ms at 100 MHz, clock version {{[0-9]+}})
# CHECK-NEXT: machine prototype-on-chip{{$}}
# CHECK: cores issue {{.*}} branch {{.*}} ended
# CHANGED: machine prototype with changes{{$}}
# WRONG: error: --clock: {{.*}}0
  .globl _start
_start:
  csrr a0, vx_core_id
  bnez a0, 2f
  li a1, 10
1:
  .rept 100
  addi a2, a2, 1
  .endr
  addi a1, a1, -1
  bnez a1, 1b
2:
  li a0, 0
  .insn r 0x0b, 0, 0, x0, a0, x0
