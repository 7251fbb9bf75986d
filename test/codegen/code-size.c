// At -Oz nothing is outlined from functions with splits, whose tokens would be
// lost; from others, the same code is.
// REQUIRES: vorion-clang
// RUN: vorion-clang -Oz -S -o - %s | FileCheck %s
// RUN: vorion-clang -Oz -S -DBRANCH="if (a & 1)" -o - %s | FileCheck --check-prefix=SPLIT %s
// CHECK: call t0, OUTLINED_FUNCTION
// SPLIT: vx_split
// SPLIT-NOT: OUTLINED_FUNCTION
#include <vorion.h>

#ifndef BRANCH
#define BRANCH
#endif

#define FUNCTION(n)                                                            \
  uint function##n(uint a, uint b, uint *p) {                                  \
    BRANCH {                                                                   \
      p[0] = (a * 3 + 7) ^ b >> 5;                                             \
      p[1] = (a << 9 | 12) * b;                                                \
      p[2] = a / b + a % (b + 1);                                              \
    }                                                                          \
    return p[n] + n;                                                           \
  }
FUNCTION(1)
FUNCTION(2)
FUNCTION(3)
FUNCTION(4)
