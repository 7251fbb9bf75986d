// vorion.h says what it needs, and what its functions take.
// REQUIRES: vorion-clang
// RUN: not vorion-clang -march=rv32imaf -mcpu=generic-rv32 -I %include -fsyntax-only %s 2>&1 | FileCheck --check-prefix=MARCH %s
// RUN: not vorion-clang -I %include -fsyntax-only %s 2>&1 | FileCheck %s
// MARCH: error: "vorion.h: the target is not a Vorion core, expected -march with xvortex"
#include "vorion.h"

void wrong(void *p) {
  // CHECK: errors.c:[[@LINE+1]]:{{.*}}error: too few arguments to function call, expected 2, have 1
  vx_bar(1);
  // CHECK: errors.c:[[@LINE+1]]:{{.*}}error: incompatible pointer to integer conversion
  vr_list_set(p);
  // CHECK: errors.c:[[@LINE+1]]:{{.*}}error: {{.*}}'void'
  uint x = vr_start_set(0);
  // CHECK: errors.c:[[@LINE+1]]:{{.*}}error: call to undeclared function 'vr_status_set'
  vr_status_set(0);
}
