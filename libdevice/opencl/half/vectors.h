/* What the functions of half share. Each computes in float: its 24 bits are at
   least twice the 11 of a half and two more, so that rounding twice gives what
   rounding once does for sums, products, quotients and roots, and the others
   keep their error in float. */
#ifndef VORION_HALF_VECTORS_H
#define VORION_HALF_VECTORS_H

#include "sizes.h"

/* Conversions of single values and vectors that round to nearest. */
#define CASTS(TO, FROM)                                                        \
  static inline TO _CL_OVERLOADABLE cast_##TO(FROM x) { return (TO)x; }        \
  FOR_VECTORS(CAST, TO, FROM)
#define CAST(N, TO, FROM)                                                      \
  static inline TO##N _CL_OVERLOADABLE cast_##TO(FROM##N x) {                  \
    return __builtin_convertvector(x, TO##N);                                  \
  }
CASTS(float, half)
CASTS(half, float)
#undef CAST
#undef CASTS

#endif
