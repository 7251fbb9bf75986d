# A run that would take for ever ends at a limit, with what each warp does.
# REQUIRES: vorion-mc, vorion-sim
# RUN: sh %S/Inputs/assemble.sh %build %s %t.elf
# RUN: sh -c 'vorion-sim %t.elf --watchdog 0.05 2> %t.err; echo "exit $?" >> %t.err'
# RUN: FileCheck %s < %t.err
# CHECK: vorion-sim: error: {{.*}}: limit reached: watchdog: the run took longer than 0.05 s
# CHECK-NEXT: core.warp 0.0 1.0 {{.*}}: running
# CHECK-NEXT: pc 0x{{[0-9a-f]+}} <_start{{.*}}>: {{.*}}, active lanes 0x0001
# CHECK: exit 5
# RUN: sh -c 'vorion-sim %t.elf --set max_instructions=1000 2> %t.err; echo "exit $?" >> %t.err'
# RUN: FileCheck %s --check-prefix=COUNT < %t.err
# COUNT: limit reached: {{[0-9]+}} instructions, the maximum
# COUNT: exit 5
# RUN: not vorion-sim %t.elf --watchdog soon 2>&1 | FileCheck %s --check-prefix=BAD
# BAD: vorion-sim: error: watchdog of 'soon', expected seconds above 0
  .globl _start
_start:
  addi t0, t0, 1        # each state is a new one: no hang
  j _start
