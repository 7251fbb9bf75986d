# What kernels read: words that a linear congruential generator draws.
#   random NAME, COUNT, MASK, OR    words (x >> 8 & MASK) | OR
# With MASK 0x7fffff and OR 0x3f800000 they are floats in [1, 2).
  .macro random name, count, mask, or
  .globl \name
  .balign 64
\name:
  .set x, 12345 + \count
  .rept \count
  .set x, (x * 1103515245 + 12345) & 0xffffffff
  .word ((x >> 8) & \mask) | \or
  .endr
  .endm

  .data
  random ones, 4096, 0x7fffff, 0x3f800000
  random bits, 1024, 0xffffff, 0
  random bytes, 1024, 0xff, 1
