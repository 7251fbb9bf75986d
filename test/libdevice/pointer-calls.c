// Functions called through pointers in which lanes differ, against the host:
// the functions that a warp's lanes call run one after the other.
// REQUIRES: vorion-clang, vorion-link, vorion-sim
// RUN: clang-19 -O1 %s -o %t.host.exe && %t.host.exe | sort -n > %t.host
// RUN: vorion-clang -O2 -Werror %s -o %t.elf && vorion-sim %t.elf | sort -n > %t.device
// RUN: diff %t.host %t.device
// RUN: vorion-clang -O0 -Werror %s -o %t.O0.elf && vorion-sim %t.O0.elf | sort -n > %t.O0.device
// RUN: diff %t.host %t.O0.device
#include "Inputs/items.h"

typedef uint64_t step(uint64_t hash, uint32_t i);

static uint64_t mixed(uint64_t hash, uint32_t i) { return mix(hash, i); }
static uint64_t shifted(uint64_t hash, uint32_t i) {
  return hash << i % 7 | hash >> 57;
}
/* Lanes leave at different times. */
static uint64_t looping(uint64_t hash, uint32_t i) {
  for (uint32_t k = 0; k < hash % 20; ++k)
    hash += mix(hash, i + k);
  return hash;
}
static step *const steps[] = {mixed, shifted, looping};

/* Calls itself through a pointer, to a lane's own depth. */
static uint64_t nested(uint64_t hash, uint32_t i) {
  step *const volatile inner = i % 5 ? nested : steps[i % 3];
  return mix(inner(hash + 1, i - (i != 0)), i);
}

static uint64_t sum;
static void add(uint64_t x) { __atomic_fetch_add(&sum, x, __ATOMIC_RELAXED); }
static void ignore(uint64_t x) { (void)x; }

struct pair {
  uint64_t first;
  uint32_t second[3];
};
static struct pair made(uint64_t x) {
  return (struct pair){x, {1, (uint32_t)x, 3}};
}
static struct pair other(uint64_t x) {
  return (struct pair){~x, {(uint32_t)x, 2, 1}};
}

void item(uint32_t i) {
  uint64_t state = seed_of(i), hash = i;
  for (int round = 0; round < 20; ++round) {
    hash = steps[next_random(&state) % 3](hash, i);
    if (hash % 3 == 0) // only some lanes call
      hash = steps[hash / 3 % 3](hash, i + 1);
    step *chosen = looping;
    while (chosen != mixed && next_random(&state) % 4) // another in each pass
      hash = (chosen = steps[next_random(&state) % 3])(hash, i);
    void (*const count)(uint64_t) = hash & 1 ? add : ignore;
    count(hash);
    const struct pair p = (hash & 2 ? made : other)(hash);
    hash = mix(hash, p.first) + p.second[i % 3];
  }
  printf("%u %08x%08x\n", (unsigned)i, (unsigned)(hash >> 32), (unsigned)hash);
  hash = nested(hash, i % 11);
  printf("%u nested %08x%08x\n", (unsigned)i, (unsigned)(hash >> 32),
         (unsigned)hash);
}
