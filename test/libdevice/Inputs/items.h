/* A test computes item(i) for each i and prints one line of it. On the device a
   lane has an item, so that neighbouring lanes work on different operands; on
   the host a loop does. Cores take turns on the console, so both outputs are
   sorted by number. */
#ifndef ITEMS_H
#define ITEMS_H

#include <stdint.h>

enum { ITEMS = 128 }; /* 8 cores of 16 lanes */

void item(uint32_t i);

#ifdef __riscv_xvortex
#include <vorion.h>
#include <vorion_print.h>
int main(void) {
  item(vx_core_id() * vx_num_threads() + vx_thread_id());
  return 0;
}
#else
#include <stdio.h>
int main(void) {
  for (uint32_t i = 0; i < ITEMS; ++i)
    item(i);
  return 0;
}
#endif

/* Numbers that are the same everywhere (xorshift64*, Vigna 2016). */
static inline uint64_t next_random(uint64_t *state) {
  *state ^= *state >> 12;
  *state ^= *state << 25;
  *state ^= *state >> 27;
  return *state * 0x2545f4914f6cdd1du;
}
static inline uint64_t seed_of(uint32_t i) {
  return (i + 1) * 0x9e3779b97f4a7c15u;
}

/* As next_random, with any number of significant bits: division has special
   paths for small numbers. */
static inline uint64_t next_operand(uint64_t *state) {
  const uint64_t x = next_random(state);
  return x >> (next_random(state) % 64);
}

static inline uint64_t mix(uint64_t hash, uint64_t value) {
  return (hash ^ value) * 0x100000001b3u + (hash >> 29);
}

#endif
