/* What the programs of bench/isasim share. Each computes work(lane, lanes) once
   a lane: on the device 16 lanes do it together, every core on data of its own;
   as a Linux program for qemu-riscv32 one lane does all of it. The result must
   not depend on the number of lanes, and lane 0 prints it. */
#ifndef BENCH_H
#define BENCH_H

#include <stdint.h>

/* This lane's part of the work; returns, in lane 0, a number that the whole
   result goes into. */
uint32_t work(uint32_t lane, uint32_t lanes);

/* Of the core's own: memory, and memory that is near. */
enum { BENCH_MEMORY = 4 << 20, BENCH_LOCAL = 16 << 10 };

#ifdef __riscv_xvortex
#include <vorion.h>
static inline void *bench_memory(void) {
  return (void *)(VX_GLOBAL_BASE + vx_core_id() * BENCH_MEMORY);
}
static inline void *bench_local(void) { return (void *)VX_LOCAL_BASE; }
#else
void *bench_memory(void);
void *bench_local(void);
#endif

/* What lanes have stored is there for all lanes of the warp, which go in
   step; the compiler must not move accesses across. */
static inline void bench_step(void) { __atomic_signal_fence(__ATOMIC_SEQ_CST); }

/* Numbers that are the same everywhere (xorshift32, Marsaglia 2003). */
static inline uint32_t bench_next(uint32_t *state) {
  uint32_t x = *state;
  x ^= x << 13;
  x ^= x >> 17;
  x ^= x << 5;
  return *state = x;
}

/* The n-th of a sequence that needs no state (Wellons 2018, "lowbias32"). */
static inline uint32_t bench_hash(uint32_t n) {
  n ^= n >> 16;
  n *= 0x7feb352du;
  n ^= n >> 15;
  n *= 0x846ca68bu;
  n ^= n >> 16;
  return n;
}

#endif
