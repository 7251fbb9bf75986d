# Kernels for Api_test.cpp, small enough for the packaged assembler: lane 0 of each
# core calls the kernel once as entry(args, launch, core).

#include "vorion_asm.h"

.macro vx_tmc_zero
    .insn r 0x0b, 0, 0, x0, x0, x0
.endm

    .text
    .globl _start
_start:
    csrr    s1, mscratch
    bnez    s1, 1f
    # As a program with main: exit code 3, a line on the console.
    li      t0, 'm'
    sw      t0, VX_IO_CONSOLE(zero)
    li      t0, '\n'
    sw      t0, VX_IO_CONSOLE(zero)
    li      t0, 3
    sw      t0, VX_IO_EXIT(zero)
    vx_tmc_zero
1:  lw      t0, VX_LAUNCH_ENTRY(s1)
    lw      a0, VX_LAUNCH_ARGS(s1)
    mv      a1, s1
    csrr    a2, VX_CSR_VX_CORE_ID   # the packaged assembler does not know its name
    jalr    t0
    vx_tmc_zero

# store(uint *out, uint value): out[core] = value + core
store:
    lw      t0, 0(a0)
    lw      t1, 4(a0)
    add     t1, t1, a2
    slli    t2, a2, 2
    add     t0, t0, t2
    sw      t1, 0(t0)
    ret

# copy_launch(uint *out): the launch block's words, from core 0
copy_launch:
    bnez    a2, 2f
    lw      t0, 0(a0)
    li      t1, VX_LAUNCH_STACK_BYTES + 4
1:  lw      t2, 0(a1)
    sw      t2, 0(t0)
    addi    a1, a1, 4
    addi    t0, t0, 4
    addi    t1, t1, -4
    bnez    t1, 1b
2:  ret

# locals(uint *out, local, local): the addresses of the local arguments
locals:
    bnez    a2, 1f
    lw      t0, 0(a0)
    lw      t1, 4(a0)
    sw      t1, 0(t0)
    lw      t1, 8(a0)
    sw      t1, 4(t0)
1:  ret

# count(uint *out): out[0] = ++counter, which lies in .data
count:
    bnez    a2, 1f
    lw      t0, 0(a0)
    la      t1, counter
    lw      t2, 0(t1)
    addi    t2, t2, 1
    sw      t2, 0(t1)
    sw      t2, 0(t0)
1:  ret

# print(uint asked): "hi\n", but asks for `asked` bytes of the buffer
print:
    bnez    a2, 1f
    lw      t0, VX_LAUNCH_PRINT_BUFFER(a1)
    li      t1, 'h'
    sb      t1, SIZEOF_VX_PRINT(t0)
    li      t1, 'i'
    sb      t1, SIZEOF_VX_PRINT+1(t0)
    li      t1, '\n'
    sb      t1, SIZEOF_VX_PRINT+2(t0)
    lw      t1, 0(a0)
    sw      t1, VX_PRINT_USED(t0)
1:  ret

fault:
    lw      t0, 0(zero)
    ret

# Waits at a barrier for a second warp that never comes.
hang:
    li      t0, 2
    .insn r 0x0b, 4, 0, x0, x0, t0
    ret

forever:
    j       forever

exit_seven:
    li      t0, 7
    sw      t0, VX_IO_EXIT(zero)
    ret

# chatter(uint words): lane 0 of core 0 stores so many console words
chatter:
    bnez    a2, 2f
    lw      t0, 0(a0)
    li      t1, 'c'
1:  sw      t1, VX_IO_CONSOLE(zero)
    addi    t0, t0, -1
    bnez    t0, 1b
2:  ret

    .data
    .p2align 2
counter: .word 40

    .section .rodata, "a"
.macro name label, text
name_\label: .asciz "\text"
.endm
    name store, "store"
    name copy_launch, "copy_launch"
    name locals, "locals"
    name count, "count"
    name print, "print"
    name fault, "fault"
    name hang, "hang"
    name forever, "forever"
    name exit_seven, "exit_seven"
    name chatter, "chatter"
    name out, "out"
    name value, "value"
    name first, "first"
    name second, "second"
    .p2align 2
args_store:
    .word name_out, VX_ARG_GLOBAL, 0, 4
    .word name_value, VX_ARG_VALUE, 4, 4
args_locals:
    .word name_out, VX_ARG_GLOBAL, 0, 4
    .word name_first, VX_ARG_LOCAL, 4, 4
    .word name_second, VX_ARG_LOCAL, 8, 4
args_out:
    .word name_out, VX_ARG_GLOBAL, 0, 4
args_print:
    .word name_value, VX_ARG_VALUE, 0, 4

.ifndef LANES // the build makes an image for another machine, too
    .set LANES, 0
.endif
.macro kernel label, args, num_args, args_bytes, context=0, local=0, size_x=0, size_y=0, size_z=0, lanes=LANES, stack=0
    .word name_\label, \label, \args, \num_args, \args_bytes, \context, \local
    .word \size_x, \size_y, \size_z, \lanes, \stack
.endm
    .section vorion_kernels, "a"
    .p2align 2
    kernel store, args_store, 2, 8
    kernel copy_launch, args_out, 1, 4, 100, 0, 4, 2, 1
    kernel locals, args_locals, 3, 12, 0, 100
    kernel count, args_out, 1, 4
    kernel print, args_print, 1, 4
    kernel fault, 0, 0, 0
    kernel hang, 0, 0, 0
    kernel forever, 0, 0, 0
    kernel exit_seven, 0, 0, 0
    kernel chatter, args_print, 1, 4
