# The first non-zero value in the exit word fails the run, and is what vorion-sim
# ends with, unless it means something else there.
# REQUIRES: vorion-mc, vorion-sim
# DEFINE: %{code} =
# DEFINE: %{run} = sh %S/Inputs/assemble.sh %build %s %t.elf --defsym=CODE=%{code} && sh -c 'vorion-sim %t.elf 2> %t.err; echo "ended with $?" >> %t.err' && cat %t.err
# REDEFINE: %{code} = 42
# RUN: %{run} | FileCheck %s --check-prefix=OWN
# OWN: vorion-sim: error: {{.*}}.elf: the program failed with exit code 42{{$}}
# OWN-NEXT: ended with 42
# REDEFINE: %{code} = 1
# RUN: %{run} | FileCheck %s --check-prefix=ONE
# ONE: the program failed with exit code 1{{$}}
# ONE-NEXT: ended with 1{{$}}
# 3 is a bad input file, 4 a trap, 5 a limit, 70 an error of vorion-sim's own.
# REDEFINE: %{code} = 2
# RUN: %{run} | FileCheck %s --check-prefix=TAKEN -DCODE=2
# REDEFINE: %{code} = 3
# RUN: %{run} | FileCheck %s --check-prefix=TAKEN -DCODE=3
# REDEFINE: %{code} = 4
# RUN: %{run} | FileCheck %s --check-prefix=TAKEN -DCODE=4
# REDEFINE: %{code} = 5
# RUN: %{run} | FileCheck %s --check-prefix=TAKEN -DCODE=5
# REDEFINE: %{code} = 70
# RUN: %{run} | FileCheck %s --check-prefix=TAKEN -DCODE=70
# The system has no such codes: 256 would be 0.
# REDEFINE: %{code} = 256
# RUN: %{run} | FileCheck %s --check-prefix=TAKEN -DCODE=256
# TAKEN: the program failed with exit code [[CODE]], for which vorion-sim exits with 1 (see --help)
# TAKEN-NEXT: ended with 1{{$}}
# RUN: vorion-sim --help | FileCheck %s --check-prefix=HELP
# HELP: exit codes: 0 ok, 1 guest failed,
# HELP: a nonzero exit code of the program is passed on, or replaced by 1 if it is in this
# HELP-NEXT: list or above 255
  .globl _start
_start:
  csrr a0, vx_core_id
  li a1, 3
  bne a0, a1, 1f
  li a0, CODE
  sw a0, 0x44(zero)
1:
  sw zero, 0x44(zero)
  vx_tmc zero
