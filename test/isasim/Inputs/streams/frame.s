# What surrounds a random program on both machines: `run` runs its blocks
# (program.s) PASSES times and jumps to `done`; [log, log + LOG_BYTES) then has
# all registers after each block of each pass, and the scratch memory after each
# pass. Addresses are the same in both programs.
  .text
  .globl run
run:
  la sp, scratch + SCRATCH / 2
  la gp, log
  la tp, table + 2048
  csrwi fcsr, 0
  .irp n, 1,5,6,7,8,9,10,11,12,13,14,15,16,17,18,19,20,21,22,23,24,25,26,27,28,29,30,31
  lw x\n, 4*\n(tp)
  .endr
  .irp n, 0,1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,17,18,19,20,21,22,23,24,25,26,27,28,29,30,31
  flw f\n, -4*\n(tp)
  .endr
pass:
  .include "program.s"
  la x5, scratch
  li x6, SCRATCH
  add x6, x6, x5
1:
  lw x7, 0(x5)
  sw x7, 0(gp)
  addi x5, x5, 4
  addi gp, gp, 4
  bne x5, x6, 1b
  addi tp, tp, 4 * TABLE_STEP
  la x5, passes_left
  lw x6, 0(x5)
  addi x6, x6, -1
  sw x6, 0(x5)
  beqz x6, 2f
  j pass            # out of a branch's reach
2:
  j done

# Appends x1 to x31, f0 to f31 and fcsr to the log; changes none of them but gp.
checkpoint:
  .irp n, 1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,17,18,19,20,21,22,23,24,25,26,27,28,29,30,31
  sw x\n, 4*(\n-1)(gp)
  .endr
  .irp n, 0,1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,17,18,19,20,21,22,23,24,25,26,27,28,29,30,31
  fsw f\n, 4*(31+\n)(gp)
  .endr
  csrr x5, fcsr
  sw x5, 4*63(gp)
  lw x5, 4*4(gp)
  addi gp, gp, 4*64
  ret

# The kernel's record. Linux has no use for it, but it takes its place there
# too: what follows must have the same addresses.
  .section .rodata
name: .asciz "stream"
out: .asciz "log"
  .balign 4
args:
  .word out, VX_ARG_GLOBAL, 0, 4
  .section vorion_kernels, "a", @progbits
  .word name, _start, args, 1, 4, 0, 0, 0, 0, 0, 0, 0

  .data
  .balign 4
passes_left:
  .word PASSES
  .include "table.s"

  .bss
  .balign 4
scratch:
  .space SCRATCH
  .globl log
log:
  .space LOG_BYTES
