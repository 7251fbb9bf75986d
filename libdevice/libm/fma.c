/* fma of doubles: x * y + z with one rounding, to nearest. */

#include "double_bits.h"

/* A finite number but 0: significand * 2^exponent, bit 52 of the significand is
   its highest. */
struct parts {
  uint64_t significand;
  int exponent;
  int negative;
};

/* An unsigned number of 128 bits. */
struct wide {
  uint64_t high, low;
};

static struct parts split(double x) {
  struct parts p;
  const uint64_t bits = bits_of(x);
  const int biased = biased_exponent(x);
  p.negative = (int)(bits >> 63);
  p.significand = bits & ((1ull << FractionBits) - 1);
  p.exponent = (biased ? biased : 1) - ExponentBias - FractionBits;
  if (biased) {
    p.significand |= 1ull << FractionBits;
  } else {
    const int up = __builtin_clzll(p.significand) - 11;
    p.significand <<= up;
    p.exponent -= up;
  }
  return p;
}

static struct wide multiply(uint64_t a, uint64_t b) {
  const uint64_t a0 = (uint32_t)a, a1 = a >> 32, b0 = (uint32_t)b, b1 = b >> 32;
  const uint64_t low = a0 * b0, cross = a1 * b0 + (low >> 32);
  const uint64_t middle = a0 * b1 + (uint32_t)cross;
  return (struct wide){a1 * b1 + (cross >> 32) + (middle >> 32),
                       middle << 32 | (uint32_t)low};
}

static struct wide shift_left(struct wide x, unsigned by) {
  if (by >= 64)
    return (struct wide){x.low << (by - 64), 0};
  if (by == 0)
    return x;
  return (struct wide){x.high << by | x.low >> (64 - by), x.low << by};
}

/* What falls out below stays as bit 0, which is enough to round by. */
static uint64_t shift_right_sticky(uint64_t x, unsigned by) {
  if (by >= 64)
    return x != 0;
  return by == 0 ? x : x >> by | (x << (64 - by) != 0);
}

static struct wide shift_wide_right_sticky(struct wide x, unsigned by) {
  if (by >= 64)
    return (struct wide){0, shift_right_sticky(x.high, by - 64) | (x.low != 0)};
  if (by == 0)
    return x;
  return (struct wide){x.high >> by,
                       x.high << (64 - by) | shift_right_sticky(x.low, by)};
}

static struct wide add(struct wide a, struct wide b) {
  const uint64_t low = a.low + b.low;
  return (struct wide){a.high + b.high + (low < a.low), low};
}

static struct wide subtract(struct wide a, struct wide b) {
  return (struct wide){a.high - b.high - (a.low < b.low), a.low - b.low};
}

static int is_less(struct wide a, struct wide b) {
  return a.high < b.high || (a.high == b.high && a.low < b.low);
}

/* significand * 2^exponent, rounded; bit 63 of the significand is set. */
static double join(int negative, uint64_t significand, int exponent) {
  const uint64_t sign = (uint64_t)negative << 63;
  enum { Spare = 63 - FractionBits };
  int biased = exponent + 63 + ExponentBias;
  if (biased >= ExponentMask)
    return from_bits(sign | (uint64_t)ExponentMask << FractionBits);
  if (biased <= 0) {
    significand = shift_right_sticky(significand, (unsigned)(1 - biased));
    biased = 1;
  }
  const uint64_t half = 1ull << (Spare - 1),
                 rest = significand & (2 * half - 1);
  significand >>= Spare;
  significand += rest > half || (rest == half && (significand & 1));
  /* The highest bit counts as one more of the exponent, and a carry goes where
     it should. */
  return from_bits(sign |
                   (((uint64_t)(biased - 1) << FractionBits) + significand));
}

double fma(double x, double y, double z) {
  if (biased_exponent(x) == ExponentMask || biased_exponent(y) == ExponentMask)
    return x * y + z;
  if (biased_exponent(z) == ExponentMask)
    return z + z;
  if (x == 0 || y == 0)
    return x * y + z;
  if (z == 0)
    return x * y;
  const struct parts a = split(x), b = split(y), c = split(z);
  /* The product's highest bit is 124 or 125, the summand's is 124, so that a
     sum has room. If one is shifted by more than it has zeros below, the other
     is so much larger that their difference keeps its highest bits. */
  struct wide product = shift_left(multiply(a.significand, b.significand), 20);
  struct wide summand = {c.significand << 8, 0};
  const int product_exponent = a.exponent + b.exponent - 20;
  const int summand_exponent = c.exponent - 72;
  int exponent = product_exponent;
  if (product_exponent >= summand_exponent) {
    summand = shift_wide_right_sticky(
        summand, (unsigned)(product_exponent - summand_exponent));
  } else {
    product = shift_wide_right_sticky(
        product, (unsigned)(summand_exponent - product_exponent));
    exponent = summand_exponent;
  }
  int negative = a.negative ^ b.negative;
  struct wide sum;
  if (negative == c.negative) {
    sum = add(product, summand);
  } else if (is_less(product, summand)) {
    sum = subtract(summand, product);
    negative = c.negative;
  } else {
    sum = subtract(product, summand);
  }
  if (sum.high == 0 && sum.low == 0)
    return 0;
  const int up =
      sum.high ? __builtin_clzll(sum.high) : 64 + __builtin_clzll(sum.low);
  sum = shift_left(sum, (unsigned)up);
  return join(negative, sum.high | (sum.low != 0), exponent - up + 64);
}
