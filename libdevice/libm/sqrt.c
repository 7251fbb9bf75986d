/* sqrt of doubles, rounded to nearest. */

#include "double_bits.h"

double sqrt(double x) {
  if (!(x > 0) || x == __builtin_inf())
    /* 0 and infinity are their own roots; less and NaN have none. */
    return x == 0 || x > 0 ? x : __builtin_nan("");
  /* x = m * 2^exponent, exponent even, m from 2^52 to 2^54. */
  int exponent = biased_exponent(x);
  uint64_t m = bits_of(x) & ((1ull << FractionBits) - 1);
  if (exponent) {
    m |= 1ull << FractionBits;
  } else {
    const int up = __builtin_clzll(m) - 11;
    m <<= up;
    exponent = 1 - up;
  }
  exponent -= ExponentBias + FractionBits;
  if (exponent & 1) {
    m <<= 1;
    exponent -= 1;
  }
  /* The float's root is good to 23 bits. A step of Newton's makes 43 of them,
     the next all 54. The remainders fit in 64 bits where the squares do not. */
  const float first = __builtin_sqrtf((float)m);
  const float half_inverse = 0.5f / first;
  const uint64_t t = (uint64_t)(uint32_t)first;
  const int64_t second =
      (int64_t)(t << 16) +
      (int32_t)((float)(int64_t)(m - t * t) * half_inverse * 0x1p16f);
  const int64_t rest =
      (int64_t)((m << 32) - (uint64_t)second * (uint64_t)second);
  uint64_t root =
      (uint64_t)(second << 11) +
      (uint64_t)(int64_t)(int32_t)((float)rest * half_inverse * 0x1p-5f);
  int64_t remainder = (int64_t)((m << 54) - root * root);
  for (; remainder < 0; remainder += (int64_t)(2 * root + 1))
    --root;
  for (; remainder > (int64_t)(2 * root); ++root)
    remainder -= (int64_t)(2 * root + 1);
  /* 53 bits and one more, which decides: no root lies half-way. */
  const int biased = exponent / 2 + 25 + ExponentBias;
  return from_bits(((root + 1) >> 1) + ((uint64_t)biased << FractionBits));
}
