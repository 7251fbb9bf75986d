/* A double's bits (IEEE 754 binary64). */
#ifndef VORION_DOUBLE_BITS_H
#define VORION_DOUBLE_BITS_H

#include <stdint.h>

enum { FractionBits = 52, ExponentBias = 1023, ExponentMask = 0x7FF };

static inline uint64_t bits_of(double x) {
  uint64_t bits;
  __builtin_memcpy(&bits, &x, sizeof(bits));
  return bits;
}

static inline double from_bits(uint64_t bits) {
  double x;
  __builtin_memcpy(&x, &bits, sizeof(x));
  return x;
}

/* 0 for zeros and subnormal numbers, ExponentMask for infinities and NaNs. */
static inline int biased_exponent(double x) {
  return (int)(bits_of(x) >> FractionBits) & ExponentMask;
}

#endif
