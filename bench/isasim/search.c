/* A divergent search: each lane walks a hash table with chains of different
   lengths, and stops where its key is. */
#include "bench.h"

enum { BUCKETS = 4096, KEYS = 16384, LOOKUPS = 131072 };

uint32_t work(uint32_t lane, uint32_t lanes) {
  uint32_t *heads = bench_memory();
  uint32_t *keys = heads + BUCKETS, *nexts = keys + KEYS;
  uint32_t *sums = bench_local();
  for (uint32_t n = lane; n < BUCKETS; n += lanes)
    heads[n] = 0;
  bench_step();
  for (uint32_t n = 1 + lane; n < KEYS; n += lanes)
    keys[n] = bench_hash(n);
  bench_step();
  if (lane == 0) /* the chains' order is the keys' */
    for (uint32_t n = 1; n < KEYS; ++n) {
      nexts[n] = heads[keys[n] % BUCKETS];
      heads[keys[n] % BUCKETS] = n;
    }
  bench_step();
  uint32_t sum = 0;
  for (uint32_t n = lane; n < LOOKUPS; n += lanes) {
    const uint32_t key = bench_hash(n % (2 * KEYS)); /* half are there */
    uint32_t at = heads[key % BUCKETS];
    while (at != 0 && keys[at] != key)
      at = nexts[at];
    sum += at ^ (at == 0 ? 0 : key);
  }
  sums[lane] = sum;
  bench_step();
  uint32_t all = 0;
  for (uint32_t l = 0; l < lanes; ++l)
    all += sums[l];
  return all;
}
