/* Least significant digit first, 4 bits a pass: a lane counts and moves a part
   of the keys, with counters of its own for each digit, so the sort is stable.
 */
#include "bench.h"

enum { KEYS = 32768, DIGITS = 16, BITS = 4, MAX_LANES = 16 };

uint32_t work(uint32_t lane, uint32_t lanes) {
  uint32_t *from = bench_memory(), *to = from + KEYS;
  uint32_t *counts = bench_local(); /* by digit, then lane */
  for (uint32_t n = lane; n < KEYS; n += lanes)
    from[n] = bench_hash(n);
  bench_step();
  const uint32_t part = KEYS / lanes;
  for (unsigned shift = 0; shift < 32; shift += BITS) {
    for (uint32_t digit = 0; digit < DIGITS; ++digit)
      counts[digit * lanes + lane] = 0;
    for (uint32_t n = lane * part; n < (lane + 1) * part; ++n)
      ++counts[(from[n] >> shift & (DIGITS - 1)) * lanes + lane];
    bench_step();
    /* Sums of all counters before: a row of lanes at a time. */
    uint32_t before = 0;
    for (uint32_t digit = 0; digit < DIGITS; ++digit)
      for (uint32_t l = 0; l < lanes; ++l) {
        const uint32_t count = counts[digit * lanes + l];
        bench_step();
        if (l == lane)
          counts[digit * lanes + l] = before;
        bench_step();
        before += count;
      }
    for (uint32_t n = lane * part; n < (lane + 1) * part; ++n) {
      const uint32_t key = from[n];
      to[counts[(key >> shift & (DIGITS - 1)) * lanes + lane]++] = key;
    }
    bench_step();
    uint32_t *swap = from;
    from = to;
    to = swap;
  }
  uint32_t sum = 0;
  if (lane == 0)
    for (uint32_t n = 0; n < KEYS; ++n)
      sum = (n && from[n] < from[n - 1]) ? ~0u : sum * 31 + from[n];
  return sum;
}
