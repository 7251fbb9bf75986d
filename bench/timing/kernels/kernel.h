/* What the whole kernels share. Each is a program of one core: main runs on all
   lanes of all warps. */
#pragma once

#include <vorion.h>

enum { LANES = 16 };

/* Inputs (inputs.s): floats in [1, 2), words below 2^24, words of 1 to 256. */
extern const float ones[4096];
extern const uint bits[1024], bytes[1024];

/* Local memory, which is at the same address everywhere. */
#define LOCAL ((volatile uint *)0xffff0000)

/* Runs over 0 to COUNT - 1, a multiple of LANES: BASE is the first item of a
   warp's lanes. */
#define FOR_WARPS(BASE, COUNT)                                                 \
  for (uint BASE = vx_warp_id() * LANES; BASE < (COUNT);                       \
       BASE += vx_num_warps() * LANES)

/* The array of COUNT words that the kernel computes, which is compared between
   machines. */
#define RESULT(TYPE, COUNT)                                                    \
  TYPE result[COUNT] __asm__("begin_signature") __attribute__((aligned(64)));  \
  __asm__(".globl end_signature\n"                                             \
          ".set end_signature, begin_signature + 4 * " #COUNT)
