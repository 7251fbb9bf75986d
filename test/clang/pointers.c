// A call through a pointer in which lanes may differ calls the functions one
// after the other; one that vx_uniform vouches for is a plain call, also where
// the pointer went through a variable of a program without optimisation. A tail
// call that must be one names its line.
// REQUIRES: vorion-clang
// RUN: vorion-clang -O2 -I %include -S %s -o - | FileCheck %s --check-prefixes=SAME,DIFFERENT
// RUN: vorion-clang -O0 -I %include -S %s -o - | FileCheck %s --check-prefixes=SAME,DIFFERENT
// RUN: not vorion-clang -g -O2 -I %include -c %s -o /dev/null -DTAIL 2>&1 | FileCheck %s
#include "vorion.h"

typedef uint (*unary)(uint);

// SAME-LABEL: same:
// SAME-NOT: vx_shfl
// SAME: {{jr|jalr}}
uint same(uint pointer, uint x) {
  unary f = (unary)vx_uniform(pointer);
  return f(x);
}

// DIFFERENT-LABEL: different:
// DIFFERENT: vx_shfl
// DIFFERENT: vx_split
// DIFFERENT: jalr
// DIFFERENT: vx_join
// DIFFERENT: vx_pred
uint different(unary f, uint x) { return f(x); }

#ifdef TAIL
uint tail(uint x, unary f) {
  // CHECK: pointers.c:[[@LINE+1]]:{{[0-9]+}}: error: a tail call through a pointer in which lanes may differ; use vx_uniform if they cannot
  __attribute__((musttail)) return ((uint(*)(uint, unary))f)(x, f);
}
#endif
