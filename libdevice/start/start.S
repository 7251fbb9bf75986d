# Where every image begins (docs/abi.md, "Start"). Lane 0 of warp 0 of each core
# arrives here alone; mscratch is the launch block's address or 0.
#
# Every branch below is uniform, so none needs a split: its operands come from
# uniform CSRs or from the launch block, the same for all lanes.

#include "vorion_asm.h"

    # For debuggers: nothing has called it.
    .cfi_sections .debug_frame
    .section .text.vorion_start, "ax", @progbits
    .globl  _start
    .type   _start, @function
_start:
    .cfi_startproc
    .cfi_undefined ra
    # All lanes: mask = ~0 >> (32 - lanes). A lane that was off keeps
    # nothing of lane 0's registers, so they are set up after this.
    csrr    t0, vx_num_threads
    neg     t1, t0
    li      t2, -1
    srl     t2, t2, t1
    vx_tmc  t2

    .option push
    .option norelax
    la      gp, __global_pointer$
    .option pop

    # sp = VX_STACK_TOP - (core * lanes + lane) * stack size
    csrr    t0, vx_num_threads
    csrr    t1, vx_core_id
    csrr    t2, vx_thread_id
    mul     t1, t1, t0
    add     t1, t1, t2
    csrr    t2, vx_stack_size
    mul     t1, t1, t2
    li      sp, VX_STACK_TOP
    sub     sp, sp, t1
    # Of 16 neighbouring cores each leaves another share of its stacks unused:
    # stacks of a power of two would begin in the same sets of the L2 slice.
    csrr    t1, vx_core_id
    andi    t1, t1, 15
    srli    t2, t2, 7
    mul     t1, t1, t2
    sub     sp, sp, t1
    li      s0, 0               # ends the chain of frames
    li      ra, 0

    csrr    s1, mscratch
    bnez    s1, groups

    call    main
    sw      a0, VX_IO_EXIT(zero)
    vx_tmc  zero

# Core c of n runs groups c, c + n, c + 2n, ... The group size is the same for
# all groups of a launch, and the work-group function returns with the mask
# that it was called with: the mask is set once.
groups:
    lw      t0, VX_LAUNCH_LOCAL_SIZE(s1)
    lw      t1, VX_LAUNCH_LOCAL_SIZE+4(s1)
    lw      t2, VX_LAUNCH_LOCAL_SIZE+8(s1)
    mul     t0, t0, t1
    mul     t0, t0, t2          # work-items of a group
    csrr    t1, vx_num_threads
    minu    t0, t0, t1
    neg     t1, t0
    li      t2, -1
    srl     t2, t2, t1
    vx_tmc  t2

    lw      s2, VX_LAUNCH_ENTRY(s1)
    lw      s3, VX_LAUNCH_ARGS(s1)
    lw      s4, VX_LAUNCH_NUM_GROUPS(s1)
    lw      s5, VX_LAUNCH_NUM_GROUPS+4(s1)
    lw      s6, VX_LAUNCH_NUM_GROUPS+8(s1)
    mul     s6, s6, s5
    mul     s6, s6, s4          # groups of the launch
    csrr    s7, vx_core_id      # this group's linear number
    csrr    s8, vx_num_cores
    bgeu    s7, s6, finish
next_group:
    remu    a2, s7, s4
    divu    t0, s7, s4
    remu    a3, t0, s5
    divu    a4, t0, s5
    mv      a0, s3
    mv      a1, s1
    jalr    s2
    add     s7, s7, s8
    bltu    s7, s6, next_group
finish:
    vx_tmc  zero
    .cfi_endproc
    .size   _start, . - _start
