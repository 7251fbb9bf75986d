# What is not an instruction or CSR of the machine is refused where it stands.
# REQUIRES: vorion-mc
# RUN: not vorion-mc -triple=riscv32 -mattr=+xvorion %s 2>&1 | FileCheck %s
# RUN: not vorion-mc -triple=riscv32 -mattr=+xvortex %s 2>&1 | FileCheck --check-prefixes=CHECK,VORTEX %s
# RUN: not vorion-mc -triple=riscv32 %s 2>&1 | FileCheck --check-prefix=PLAIN %s

# VORTEX: :[[@LINE+1]]:10: error: system register use requires an option to be enabled
csrr a0, vr_list

# CHECK: :[[@LINE+2]]:1: error: too few operands for instruction
# PLAIN: :[[@LINE+1]]:1: error: too few operands for instruction
vx_split a0

# CHECK: :[[@LINE+1]]:14: error: invalid operand for instruction
vx_split a0, 5

# CHECK: :[[@LINE+1]]:13: error: invalid operand for instruction
vx_join a0, a1

# CHECK: :[[@LINE+1]]:1: error: too few operands for instruction
vx_shfl_idx a0, a1

# CHECK: :[[@LINE+1]]:8: error: invalid operand for instruction
vx_tmc f0

# CHECK: :[[@LINE+1]]:10: error: operand must be a valid system register name or an integer in the range [0, 4095]
csrr a0, vr_nothing

# CHECK: :[[@LINE+1]]:1: error: unrecognized instruction mnemonic
vx_foo a0

# PLAIN: :[[@LINE+1]]:1: error: instruction requires the following: 'XVortex' (SIMT threads)
vx_tmc a0
