// Products and quotients of _Complex numbers, for which the compiler calls
// functions, against compiler-rt's on the host: any operands, infinite ones and
// NaNs.
// REQUIRES: vorion-clang, vorion-link, vorion-sim
// RUN: vorion-clang -O2 -ffp-contract=off %s -o %t.elf
// RUN: vorion-sim %t.elf | sort -n > %t.device
// RUN: clang-19 -O1 -ffp-contract=off --rtlib=compiler-rt %s -lm -o %t.host.exe
// RUN: %t.host.exe | sort -n > %t.host
// RUN: diff %t.host %t.device
#include "Inputs/items.h"

/* NaNs are all the same. */
static uint64_t bits_of_float(float x) {
  return x != x ? 0x7fc00000 : __builtin_bit_cast(uint32_t, x);
}

static uint64_t bits_of_double(double x) {
  return x != x ? 0x7ff8000000000000 : __builtin_bit_cast(uint64_t, x);
}

/* A quarter of them are special, the others of any exponent or near one. */
static float float_operand(uint64_t *state) {
  const uint32_t special[] = {0,          1,          0x3f800000, 0x7f7fffff,
                              0x7f800000, 0x7fc00000, 0x80000000, 0xff800000};
  const uint64_t bits = next_random(state), how = next_random(state);
  const uint32_t word = (uint32_t)bits;
  switch (how % 4) {
  case 0:
    return __builtin_bit_cast(float, special[(how >> 8) % 8]);
  case 1:
    return __builtin_bit_cast(
        float, (word & 0x7f800000) == 0x7f800000 ? word | 0x400000 : word);
  default:
    return __builtin_bit_cast(
        float, (word & 0x807fffff) | (uint32_t)(117 + (how >> 8) % 20) << 23);
  }
}

static _Complex float float_pair(uint64_t *state) {
  _Complex float z;
  __real__ z = float_operand(state);
  __imag__ z = float_operand(state);
  return z;
}

void item(uint32_t i) {
  uint64_t state = seed_of(i), hash = 0;
  for (int round_of = 0; round_of < 100; ++round_of) {
    const _Complex float x = float_pair(&state), y = float_pair(&state);
    const _Complex float product = x * y, quotient = x / y;
    const _Complex double a = x, b = y;
    const _Complex double products = a * b, quotients = a / b;
    hash = mix(hash, bits_of_float(__real__ product));
    hash = mix(hash, bits_of_float(__imag__ product));
    hash = mix(hash, bits_of_float(__real__ quotient));
    hash = mix(hash, bits_of_float(__imag__ quotient));
    hash = mix(hash, bits_of_double(__real__ products));
    hash = mix(hash, bits_of_double(__imag__ products));
    hash = mix(hash, bits_of_double(__real__ quotients));
    hash = mix(hash, bits_of_double(__imag__ quotients));
  }
  printf("%u: %016llx\n", (unsigned)i, (unsigned long long)hash);
}
