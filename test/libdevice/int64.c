// 64-bit arithmetic on different operands in each lane, against the host.
// REQUIRES: vorion-clang, vorion-link, vorion-sim
// RUN: vorion-clang -O2 %s -o %t.elf && vorion-sim %t.elf | sort -n > %t.device
// RUN: clang-19 -O1 %s -o %t.host.exe && %t.host.exe | sort -n > %t.host
// RUN: diff %t.host %t.device
// RUN: vorion-clang -O0 %s -o %t.O0.elf && vorion-sim %t.O0.elf | sort -n > %t.O0.device
// RUN: diff %t.host %t.O0.device
#include "Inputs/items.h"

#define LL(x) ((unsigned long long)(x))

void item(uint32_t i) {
  uint64_t state = seed_of(i), hash = 0;
  uint64_t q = 0, r = 0;
  int64_t sq = 0, sr = 0;
  for (int round = 0; round < 40; ++round) {
    const uint64_t a = next_operand(&state);
    const uint64_t b = next_operand(&state) | 1;
    const unsigned shift = next_random(&state) % 64;
    q = a / b;
    r = a % b;
    /* A divisor of -1 could overflow, which is undefined. */
    const int64_t positive = (int64_t)(b >> 1) + 2;
    const int64_t sa = (int64_t)(a << 1);
    const int64_t sb = next_random(&state) & 1 ? positive : -positive;
    sq = sa / sb;
    sr = sa % sb;
    hash = mix(hash, q);
    hash = mix(hash, r);
    hash = mix(hash, (uint64_t)sq);
    hash = mix(hash, (uint64_t)sr);
    hash = mix(hash, a * b);
    hash = mix(hash, a << shift);
    hash = mix(hash, a >> shift);
    hash = mix(hash, (uint64_t)(sa >> shift));
    hash = mix(hash, (uint64_t)__builtin_ctzll(b));
    hash = mix(hash, (uint64_t)__builtin_clzll(b));
    hash = mix(hash, (uint64_t)__builtin_popcountll(a));
    hash = mix(hash, __builtin_bswap64(a));
    hash = mix(hash, (uint64_t)(a < b) * 2 + (sa < sb));
    int64_t product;
    hash = mix(hash, (uint64_t)__builtin_mul_overflow(sa, sb, &product));
  }
  printf("%u: %016llx %llx %llx %llx %llx\n", (unsigned)i, LL(hash), LL(q),
         LL(r), LL(sq), LL(sr));
}
