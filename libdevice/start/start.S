# Where every image begins (docs/abi.md, "Start"). Lane 0 of warp 0 of each core
# arrives here alone; mscratch is the launch block's address or 0.
#
# Every branch below is uniform, so none needs a split: its operands come from
# uniform CSRs or from the launch block, the same for all lanes.

#include "vorion_asm.h"

    # All lanes: mask = ~0 >> (32 - lanes). A lane that was off keeps
    # nothing of lane 0's registers, so they are set up after this.
    .macro  all_lanes
    csrr    t0, vx_num_threads
    neg     t1, t0
    li      t2, -1
    srl     t2, t2, t1
    vx_tmc  t2

    .option push
    .option norelax
    la      gp, __global_pointer$
    .option pop
    .endm

    # The number of the core, or of the warp of all that run groups; s9: how
    # many of a core do.
    .macro  core_number to
    csrr    \to, vx_core_id
    .endm
    .macro  warp_number to
    csrr    \to, vx_core_id
    mul     \to, \to, s9
    csrr    t3, vx_warp_id
    add     \to, \to, t3
    .endm

    # sp = VX_STACK_TOP - (number * lanes + lane) * stack size
    .macro  make_stacks number
    csrr    t0, vx_num_threads
    \number t1
    csrr    t2, vx_thread_id
    mul     t1, t1, t0
    add     t1, t1, t2
    csrr    t2, vx_stack_size
    mul     t1, t1, t2
    li      sp, VX_STACK_TOP
    sub     sp, sp, t1
    # Of 16 neighbours each leaves another share of its stacks unused: stacks
    # of a power of two would begin in the same sets of the L2 slice.
    \number t1
    andi    t1, t1, 15
    srli    t2, t2, 7
    mul     t1, t1, t2
    sub     sp, sp, t1
    li      s0, 0               # ends the chain of frames
    li      ra, 0
    .endm

    # The lanes of a group, and what the launch block at s1 says of groups. The
    # group size is the same for all groups of a launch, and the work-group
    # function returns with the mask that it was called with: it is set once.
    .macro  read_launch
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
    .endm

    # For debuggers: nothing has called it.
    .cfi_sections .debug_frame
    .section .text.vorion_start, "ax", @progbits
    .globl  _start
    .type   _start, @function
_start:
    .cfi_startproc
    .cfi_undefined ra
    all_lanes
    make_stacks core_number

    csrr    s1, mscratch
    bnez    s1, groups

    # main, or what runs it (vorion.ld). The linker looks for main first, so that
    # the functions of the library lie where they lie without static objects.
    .reloc  ., R_RISCV_NONE, main
    call    vorion_main
    sw      a0, VX_IO_EXIT(zero)
    vx_tmc  zero

# Core c of n runs groups c, c + n, c + 2n, ...
groups:
    read_launch
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

# Where a launch of several warps a core begins. It has a section of its own
# behind all other code, whose places in the instruction cache it leaves alone.
    .section vorion_warps, "ax", @progbits
    .globl  _start_warps
    .type   _start_warps, @function
_start_warps:
    .cfi_startproc
    .cfi_undefined ra
    csrr    t0, mscratch
    lw      t0, VX_LAUNCH_WARPS(t0)
    la      t1, warp
    vx_wspawn t0, t1

# Warp w of core c has the launch's block w, its own part of local memory, and
# of n cores' groups c + w * n and every (warps * n)th behind it.
warp:
    all_lanes
    csrr    s1, mscratch
    lw      s9, VX_LAUNCH_WARPS(s1)
    make_stacks warp_number
    csrr    s7, vx_warp_id
    lw      t0, VX_LAUNCH_LOCAL_STRIDE(s1)
    mul     t0, t0, s7
    csrw    vx_local_offset, t0
    li      t0, SIZEOF_VX_LAUNCH
    mul     t0, t0, s7
    add     s1, s1, t0
    read_launch
    csrr    s8, vx_num_cores
    mul     s7, s7, s8
    csrr    t0, vx_core_id
    add     s7, s7, t0          # this group's linear number
    mul     s8, s8, s9
    bgeu    s7, s6, idle
    jump    next_group, t0      # an image may be larger than j reaches
idle:
    vx_tmc  zero
    .cfi_endproc
    .size   _start_warps, . - _start_warps
