// Atomics of 64 bits in C, each lane on a word of its stack and on one of its
// own in an array, against the host.
// REQUIRES: vorion-clang, vorion-link, vorion-sim
// RUN: vorion-clang -O2 -Werror %s -o %t.elf && vorion-sim %t.elf | sort -n > %t.device
// RUN: clang-19 -O1 %s -o %t.host.exe && %t.host.exe | sort -n > %t.host
// RUN: diff %t.host %t.device
// RUN: vorion-clang -O0 %s -o %t.O0.elf && vorion-sim %t.O0.elf | sort -n > %t.O0.device
// RUN: diff %t.host %t.O0.device
#include "Inputs/items.h"

#include <stdatomic.h>

static uint64_t changed(uint64_t hash, uint64_t *word, uint64_t operand) {
  int64_t *number = (int64_t *)word;
  hash = mix(hash, __sync_fetch_and_add(word, operand));
  hash = mix(hash, __sync_sub_and_fetch(word, operand >> 7));
  hash = mix(hash, __sync_fetch_and_or(word, operand & 0xF0F0F));
  hash = mix(hash, __atomic_fetch_nand(word, operand << 3, __ATOMIC_RELAXED));
  hash = mix(hash, __sync_val_compare_and_swap(word, *word ^ (operand & 1),
                                               operand * 3));
  hash = mix(hash, (uint64_t)__atomic_fetch_max(number, (int64_t)operand,
                                                __ATOMIC_ACQ_REL));
  hash = mix(hash, (uint64_t)__atomic_fetch_min(number, (int64_t)(operand << 5),
                                                __ATOMIC_SEQ_CST));
  hash = mix(hash, __atomic_exchange_n(word, operand, __ATOMIC_ACQUIRE));
  __atomic_store_n(word, operand + hash, __ATOMIC_RELEASE);
  return mix(hash, __atomic_load_n(word, __ATOMIC_ACQUIRE));
}

void item(uint32_t i) {
  static uint64_t words[ITEMS];
  uint64_t state = seed_of(i), hash = 0, own = next_random(&state);
  _Atomic double sum = 0;
  _Atomic uint64_t total = 1;
  words[i] = own;
  for (int round = 0; round < 20; ++round) {
    const uint64_t operand = next_operand(&state);
    hash = changed(hash, &own, operand);
    hash = changed(hash, &words[i], operand);
    sum += (double)(operand & 0xFFFF);
    total *= operand | 1;
    total += operand;
    hash = mix(hash, total);
  }
  printf("%u: %016llx %d %d\n", (unsigned)i, (unsigned long long)hash, (int)sum,
         atomic_is_lock_free(&sum));
}
