/* The lesser and the greater double. A NaN gives way to a number, and -0 is
   less than 0, as where the compiler computes with constants. */
#include "double_bits.h"

/* Ordered as the numbers are, -0 before 0. */
static int64_t place(double x) {
  const int64_t bits = (int64_t)bits_of(x);
  return bits < 0 ? bits ^ INT64_MAX : bits;
}

static int is_nan(double x) {
  return bits_of(x) << 1 > (uint64_t)ExponentMask << (FractionBits + 1);
}

double fmin(double x, double y) {
  return is_nan(y) || (!is_nan(x) && place(x) < place(y)) ? x : y;
}

double fmax(double x, double y) {
  return is_nan(y) || (!is_nan(x) && place(x) > place(y)) ? x : y;
}
