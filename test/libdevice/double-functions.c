// Functions of doubles that the compiler calls, against the host's: any
// operands, sums that nearly cancel, subnormal and infinite ones.
// REQUIRES: vorion-clang, vorion-link, vorion-sim
// RUN: vorion-clang -O2 -fno-builtin %s -o %t.elf && vorion-sim %t.elf | sort -n > %t.device
// RUN: clang-19 -O1 -fno-builtin %s -lm -o %t.host.exe && %t.host.exe | sort -n > %t.host
// RUN: diff %t.host %t.device
#include "Inputs/items.h"

double fma(double x, double y, double z);
double sqrt(double x);
double floor(double x);
double ceil(double x);
double trunc(double x);
double round(double x);
double rint(double x);
double fmin(double x, double y);
double fmax(double x, double y);

/* NaNs are all the same. */
static uint64_t bits_of(double x) {
  return x != x ? 0x7ff8000000000000 : __builtin_bit_cast(uint64_t, x);
}

/* A quarter of them have any exponent, others magnitudes from 2^-60 to 2^60,
   few digits, or are special. */
static double operand(uint64_t *state) {
  const uint64_t special[] = {0,
                              1,
                              0x000fffffffffffff,
                              0x0010000000000000,
                              0x3fe0000000000000,
                              0x3ff0000000000000,
                              0x4004000000000000,
                              0x7fefffffffffffff,
                              0x7ff0000000000000,
                              0x7ff8000000000000};
  const uint64_t bits = next_random(state), how = next_random(state);
  const uint64_t near = (bits & 0x800fffffffffffff) | (963 + (how >> 8) % 120)
                                                          << 52;
  switch (how % 4) {
  case 0:
    return __builtin_bit_cast(double, bits | (uint64_t)1 << 51);
  case 1:
    return __builtin_bit_cast(double, near);
  case 2:
    return __builtin_bit_cast(double, near & ~(uint64_t)0 << (how >> 32) % 53);
  default:
    return __builtin_bit_cast(double, special[(how >> 8) % 10] |
                                          (bits & (uint64_t)1 << 63));
  }
}

void item(uint32_t i) {
  uint64_t state = seed_of(i), hash = 0;
  for (int round_of = 0; round_of < 200; ++round_of) {
    const double x = operand(&state), y = operand(&state), z = operand(&state);
    hash = mix(hash, bits_of(fma(x, y, z)));
    hash = mix(hash, bits_of(fma(x, y, -(x * y))));
    hash = mix(hash, bits_of(sqrt(x)));
    hash = mix(hash, bits_of(floor(x)));
    hash = mix(hash, bits_of(ceil(x)));
    hash = mix(hash, bits_of(trunc(x)));
    hash = mix(hash, bits_of(round(x)));
    hash = mix(hash, bits_of(rint(x)));
    if (x != 0 || y != 0) { /* the sign of a zero is free */
      hash = mix(hash, bits_of(fmin(x, y)));
      hash = mix(hash, bits_of(fmax(x, y)));
    }
  }
  printf("%u: %016llx\n", (unsigned)i, (unsigned long long)hash);
}
