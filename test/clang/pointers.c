// A call through a pointer in which lanes may differ names its line at every
// level; one that vx_uniform vouches for is a plain call, also where the
// pointer went through a variable of a program without optimisation.
// REQUIRES: vorion-clang
// RUN: not vorion-clang -g -O2 -I %include -c %s -o /dev/null -DDIFFERENT 2>&1 | FileCheck %s
// RUN: not vorion-clang -g -O0 -I %include -c %s -o /dev/null -DDIFFERENT 2>&1 | FileCheck %s
// RUN: vorion-clang -O2 -I %include -S %s -o - | FileCheck %s --check-prefix=SAME
// RUN: vorion-clang -O0 -I %include -S %s -o - | FileCheck %s --check-prefix=SAME
#include "vorion.h"

typedef uint (*unary)(uint);

#ifdef DIFFERENT
uint different(unary f, uint x) {
  // CHECK: pointers.c:[[@LINE+1]]:10: error: a call through a pointer in which lanes may differ; use vx_uniform if they cannot
  return f(x);
}
#endif

// SAME-LABEL: same:
// SAME: {{jr|jalr}}
uint same(uint pointer, uint x) {
  unary f = (unary)vx_uniform(pointer);
  return f(x);
}
