#include "templates.h"

/* Rounded once. A product of halves is exact in float. The sum is rounded to
   the odd neighbour if it is between two floats, so that rounding to half then
   rounds as if for the first time (Boldo and Melquiond, "Emulation of FMA and
   correctly rounded sums", 2008). */
static half fma_of_halves(half a, half b, half c) {
  const float product = (float)a * b, sum = product + c;
  /* What the sum lost, exactly: Knuth's two-sum. */
  const float added = sum - product;
  const float lost = (product - (sum - added)) + (c - added);
  const bool between = isfinite(sum) && lost != 0 && (as_int(sum) & 1) == 0;
  const int step = (lost > 0) == (sum > 0) ? 1 : -1;
  return (half)as_float(as_int(sum) + (between ? step : 0));
}
#define __builtin_fmaf16 fma_of_halves

DEFINE_BUILTIN_V_VVV(fma)
