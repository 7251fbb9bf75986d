// long double, of which the machine has nothing and the compiler calls
// functions for everything, against numbers of 128 bits on the host (libgcc's):
// any operands, sums that nearly cancel, ties, subnormal and infinite ones.
// REQUIRES: vorion-clang, vorion-link, vorion-sim
// RUN: clang-19 -O1 %s -o %t.host.exe && %t.host.exe | sort -n > %t.host
// RUN: vorion-clang -O2 -Werror %s -o %t.elf && vorion-sim %t.elf | sort -n > %t.device
// RUN: diff %t.host %t.device
// RUN: vorion-clang -O0 -Werror %s -o %t.O0.elf && vorion-sim %t.O0.elf | sort -n > %t.O0.device
// RUN: diff %t.host %t.O0.device
#include "Inputs/items.h"

#ifdef __riscv
typedef long double quad;
_Static_assert(sizeof(quad) == 16, "");
#else
typedef __float128 quad;
#endif

struct bits {
  uint64_t low, high;
};

static quad quad_of(struct bits b) { return __builtin_bit_cast(quad, b); }

/* NaNs are all the same. */
static uint64_t hashed(uint64_t hash, quad x) {
  const struct bits b = __builtin_bit_cast(struct bits, x);
  return x != x ? mix(hash, 1) : mix(mix(hash, b.low), b.high);
}
static uint64_t double_bits(double x) {
  return x != x ? 1 : __builtin_bit_cast(uint64_t, x);
}
static uint64_t float_bits(float x) {
  return x != x ? 1 : __builtin_bit_cast(uint32_t, x);
}
static uint64_t half_bits(_Float16 x) {
  return x != x ? 1 : __builtin_bit_cast(uint16_t, x);
}

/* Of any exponent, near 1, with few digits, or special. */
static quad operand(uint64_t *state) {
  const struct bits special[] = {{0, 0},
                                 {1, 0},
                                 {~(uint64_t)0, 0xffffffffffff},
                                 {0, 0x0001000000000000},
                                 {0, 0x3fff000000000000},
                                 {0, 0x3ffe000000000000},
                                 {0, 0x3fff800000000000},
                                 {~(uint64_t)0, 0x7ffeffffffffffff},
                                 {0, 0x7fff000000000000},
                                 {0, 0x7fff800000000000}};
  struct bits b = {next_random(state), next_random(state)};
  const uint64_t how = next_random(state), sign = b.high & (uint64_t)1 << 63;
  const uint64_t fraction = b.high & 0xffffffffffff;
  switch (how % 4) {
  case 0: /* any number that is none of the NaNs */
    return quad_of((struct bits){b.low, b.high & ~((uint64_t)1 << 48)});
  case 1: /* 2^-80 to 2^80: all integers, floats and doubles are near */
    b.high = sign | (16303 + (how >> 8) % 160) << 48 | fraction;
    return quad_of(b);
  case 2:
    b.high = sign | (16303 + (how >> 8) % 160) << 48 |
             (fraction & ~(uint64_t)0 << (how >> 32) % 49);
    b.low = how >> 40 & 1 ? 0 : ~(uint64_t)0 << (how >> 41) % 64;
    return quad_of(b);
  default:
    b = special[(how >> 8) % 10];
    b.high |= sign;
    return quad_of(b);
  }
}

/* A conversion to an integer is defined if it fits. */
static uint64_t integers(uint64_t hash, quad x) {
  if (x > -2147483649.0 && x < 2147483648.0)
    hash = mix(hash, (uint64_t)(int32_t)x);
  if (x > -1 && x < 4294967296.0)
    hash = mix(hash, (uint32_t)x);
  if (x >= -0x1p63 && x < 0x1p63)
    hash = mix(hash, (uint64_t)(int64_t)x);
  if (x > -1 && x < 0x1p64)
    hash = mix(hash, (uint64_t)x);
  return hash;
}

void item(uint32_t i) {
  uint64_t state = seed_of(i), hash = 0;
  for (int round = 0; round < 100; ++round) {
    const quad x = operand(&state), y = operand(&state);
    hash = hashed(hash, x + y);
    hash = hashed(hash, x - y);
    hash = hashed(hash, (x + y) - x); // nearly cancels
    hash = hashed(hash, x * y);
    hash = hashed(hash, x / y);
    hash = hashed(hash, -x);
    hash = mix(hash, (x < y) | (x <= y) << 1 | (x > y) << 2 | (x >= y) << 3 |
                         (x == y) << 4 | (x != y) << 5 |
                         __builtin_isunordered(x, y) << 6 |
                         __builtin_islessgreater(x, y) << 7);
    hash = mix(hash, double_bits((double)x));
    hash = mix(hash, float_bits((float)x));
    hash = mix(hash, half_bits((_Float16)x));
    const uint64_t bits = next_operand(&state);
    hash = hashed(hash, (quad) __builtin_bit_cast(double, bits));
    hash = hashed(hash, (quad) __builtin_bit_cast(float, (uint32_t)bits));
    hash = hashed(hash, (quad) __builtin_bit_cast(_Float16, (uint16_t)bits));
    hash = hashed(hash, (quad)bits);
    hash = hashed(hash, (quad)(int64_t)bits);
    hash = hashed(hash, (quad)(uint32_t)bits);
    hash = hashed(hash, (quad)(int32_t)bits);
    hash = integers(hash, x);
    hash = integers(hash, (quad)(int64_t)bits + (quad)0.75);
  }
#ifdef __riscv
  /* The functions of complex numbers and powers are there, too. */
  volatile _Complex long double z = 3.0L;
  z = z * z / z;
  volatile int power = 3;
  if (z != 3.0L || __builtin_powil(3.0L, power) != 27.0L)
    hash = 0;
#endif
  printf("%u %08x%08x\n", (unsigned)i, (unsigned)(hash >> 32), (unsigned)hash);
}
