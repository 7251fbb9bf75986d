// memcpy, memmove, memset and memcmp at every alignment, each lane another one.
// REQUIRES: vorion-clang, vorion-link, vorion-sim
// RUN: vorion-clang -O2 %s -o %t.elf && vorion-sim %t.elf | sort -n > %t.device
// RUN: clang-19 -O1 -fno-builtin %s -o %t.host.exe && %t.host.exe | sort -n > %t.host
// RUN: diff %t.host %t.device
#include "Inputs/items.h"

#include <stddef.h>
void *memcpy(void *, const void *, size_t);
void *memmove(void *, const void *, size_t);
void *memset(void *, int, size_t);
int memcmp(const void *, const void *, size_t);

enum { SIZE = 96 };

static uint64_t hash_of(const unsigned char *bytes) {
  uint64_t hash = 0;
  for (int i = 0; i < SIZE; ++i)
    hash = mix(hash, bytes[i]);
  return hash;
}

void item(uint32_t i) {
  uint64_t state = seed_of(i), hash = 0;
  unsigned char buffer[SIZE], other[SIZE];
  for (int k = 0; k < SIZE; ++k)
    buffer[k] = other[k] = (unsigned char)next_random(&state);
  for (int round = 0; round < 20; ++round) {
    const uint64_t r = next_random(&state);
    const size_t to = r % 40, from = r / 64 % 40, size = r / 4096 % 50;
    memmove(buffer + to, buffer + from, size);
    hash = mix(hash, hash_of(buffer));
    memcpy(other + to, buffer + from, size);
    hash = mix(hash, hash_of(other));
    memset(buffer + from, (int)(r >> 32), size / 2);
    hash = mix(hash, hash_of(buffer));
    const int order = memcmp(buffer + to, other + to, size);
    hash = mix(hash, (uint64_t)((order > 0) - (order < 0)));
  }
  printf("%u: %016llx\n", (unsigned)i, (unsigned long long)hash);
}
