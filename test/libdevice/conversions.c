// float and 64-bit integers, float and double, double arithmetic: all software
// on the device, against the host.
// REQUIRES: vorion-clang, vorion-link, vorion-sim
// RUN: vorion-clang -O2 %s -o %t.elf && vorion-sim %t.elf | sort -n > %t.device
// RUN: clang-19 -O1 -ffp-contract=off %s -o %t.host.exe && %t.host.exe | sort -n > %t.host
// RUN: diff %t.host %t.device
#include "Inputs/items.h"

static uint32_t float_bits(float x) {
  uint32_t bits;
  __builtin_memcpy(&bits, &x, sizeof(bits));
  return bits;
}
static uint64_t double_bits(double x) {
  uint64_t bits;
  __builtin_memcpy(&bits, &x, sizeof(bits));
  return bits;
}
static double double_of(uint64_t bits) {
  double x;
  __builtin_memcpy(&x, &bits, sizeof(x));
  return x;
}
/* A finite double with an exponent of +-limit. */
static double random_double(uint64_t *state, unsigned limit) {
  const uint64_t bits = next_random(state);
  const uint64_t exponent = 1023 - limit + (bits >> 52) % (2 * limit);
  return double_of((bits & 0x800fffffffffffff) | exponent << 52);
}

void item(uint32_t i) {
  uint64_t state = seed_of(i), hash = 0;
  for (int round = 0; round < 40; ++round) {
    const uint64_t a = next_operand(&state);
    hash = mix(hash, float_bits((float)a));
    hash = mix(hash, float_bits((float)(int64_t)a));
    hash = mix(hash, double_bits((double)a));
    hash = mix(hash, double_bits((double)(int64_t)a));

    const double x = random_double(&state, 62), y = random_double(&state, 900);
    const double z = random_double(&state, 30);
    hash = mix(hash, (uint64_t)(int64_t)x);
    hash = mix(hash, (uint64_t)(x < 0 ? -x : x));
    hash = mix(hash, (uint64_t)(int64_t)(float)x);
    hash = mix(hash, (uint64_t)(float)(x < 0 ? -x : x));
    hash = mix(hash, (uint32_t)(int32_t)z);
    hash = mix(hash, float_bits((float)x));
    hash = mix(hash, double_bits((double)(float)z));
    hash = mix(hash, double_bits(x + z));
    hash = mix(hash, double_bits(x - y));
    hash = mix(hash, double_bits(x * y));
    hash = mix(hash, double_bits(y / z));
    hash = mix(hash, (uint64_t)((x < z) + 2 * (x == z) + 4 * (y >= z)));
    const _Float16 half = (_Float16)(float)(z / 1e5);
    hash = mix(hash, float_bits((float)half));
    // Through memory: what a conversion returns, and what another takes, is a
    // half wherever it lies.
    uint16_t bits;
    __builtin_memcpy(&bits, &half, sizeof(bits));
    hash = mix(hash, bits);
    const uint16_t other = bits ^ (a & 0xFF);
    _Float16 changed;
    __builtin_memcpy(&changed, &other, sizeof(other));
    hash = mix(hash, float_bits((float)changed));
    hash = mix(hash, float_bits((float)(_Float16)(changed + half)));
  }
  printf("%u: %016llx\n", (unsigned)i, (unsigned long long)hash);
}
