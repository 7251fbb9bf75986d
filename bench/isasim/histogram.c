/* Atomic additions: to counters that are near, some of which many lanes want at
   once, and from time to time to those in memory. */
#include "bench.h"

enum { BINS = 256, VALUES = 262144, BATCH = 16384 };

uint32_t work(uint32_t lane, uint32_t lanes) {
  uint32_t *totals = bench_memory(), *bins = bench_local();
  for (uint32_t n = lane; n < BINS; n += lanes)
    totals[n] = bins[n] = 0;
  bench_step();
  for (uint32_t first = 0; first < VALUES; first += BATCH) {
    for (uint32_t n = first + lane; n < first + BATCH; n += lanes) {
      const uint32_t hash = bench_hash(n);
      /* Small bins more often than others. */
      const uint32_t bin = (hash & 255) & (hash >> 8);
      __atomic_fetch_add(&bins[bin], 1, __ATOMIC_RELAXED);
    }
    bench_step();
    for (uint32_t n = lane; n < BINS; n += lanes) {
      __atomic_fetch_add(&totals[n], bins[n], __ATOMIC_RELAXED);
      bins[n] = 0;
    }
    bench_step();
  }
  uint32_t sum = 0;
  for (uint32_t n = 0; n < BINS; ++n)
    sum = sum * 31 + totals[n];
  return sum;
}
