/* Doubles to whole doubles, in integer arithmetic. */

#include "double_bits.h"

static const uint64_t Sign = 1ull << 63;

static int exponent_of(double x) { return biased_exponent(x) - ExponentBias; }

/* The bits behind the point, where the exponent is from 0 to 51. */
static uint64_t fraction_mask(int exponent) {
  return (1ull << (FractionBits - exponent)) - 1;
}

/* 0 or 1, with the sign of x. */
static double small(double x, int one) {
  const uint64_t magnitude = one ? (uint64_t)ExponentBias << FractionBits : 0;
  return from_bits((bits_of(x) & Sign) | magnitude);
}

static double away_or_cut(double x, int away) {
  const int exponent = exponent_of(x);
  if (exponent < 0)
    return small(x, away && (bits_of(x) & ~Sign) != 0);
  if (exponent >= FractionBits)
    return x;
  const uint64_t mask = fraction_mask(exponent);
  /* A carry into the exponent is right, too. */
  return from_bits((bits_of(x) + (away ? mask : 0)) & ~mask);
}

double trunc(double x) { return away_or_cut(x, 0); }

double floor(double x) { return away_or_cut(x, (bits_of(x) & Sign) != 0); }

double ceil(double x) { return away_or_cut(x, (bits_of(x) & Sign) == 0); }

double round(double x) {
  const int exponent = exponent_of(x);
  if (exponent < 0)
    return small(x, exponent == -1);
  if (exponent >= FractionBits)
    return x;
  const uint64_t mask = fraction_mask(exponent);
  return from_bits((bits_of(x) + (mask + 1) / 2) & ~mask);
}

double rint(double x) {
  const uint64_t bits = bits_of(x);
  const int exponent = exponent_of(x);
  if (exponent < 0)
    return small(x, exponent == -1 && bits << 12 != 0);
  if (exponent >= FractionBits)
    return x;
  const uint64_t mask = fraction_mask(exponent);
  /* Where the lowest whole bit is the hidden one, this is the exponent's lowest
     bit, which is 1, too. */
  const uint64_t odd = bits >> (FractionBits - exponent) & 1;
  return from_bits((bits + mask / 2 + odd) & ~mask);
}

double nearbyint(double x) { return rint(x); }
double roundeven(double x) { return rint(x); }
