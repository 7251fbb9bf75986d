// A barrier under a condition that is computed from the lane's number is warned
// of with its line; conditions that lanes may agree in are not. Lanes that do
// part before a barrier stop the program.
// REQUIRES: vorion-clang, vorion-link, vorion-sim
// RUN: vorion-clang -O2 %s -o %t.elf 2>&1 | FileCheck %s --check-prefix=WARN --implicit-check-not=warning:
// RUN: not vorion-sim %t.elf 2>&1 | FileCheck %s --check-prefix=TRAP
// TRAP: vorion-sim: error: {{.*}}: barrier that not all lanes of the warp have reached
// TRAP: vx_bar
// RUN: vorion-clang -O2 -g -DAGREE %s -o %t.agree.elf 2>&1 | FileCheck %s --allow-empty --check-prefix=AGREE --implicit-check-not=warning:
// RUN: vorion-sim %t.agree.elf
// AGREE-NOT: error
// RUN: vorion-clang -O2 -g -c %s -o /dev/null 2>&1 | FileCheck %s --check-prefix=LINE
#include <vorion.h>

__attribute__((noinline)) static void meet(void) { vx_bar(0, 1); }

__attribute__((noinline)) static void same(uint x) {
  // x may differ between lanes, but nothing says that it does.
  if (x > 3)
    vx_bar(0, 1);
  if (vx_vote_any(vx_thread_id() > 7))
    vx_bar(0, 1);
  for (uint i = 0; i < vx_num_threads(); ++i)
    vx_bar(0, 1);
  uint odd = vx_thread_id() & 1, sum = 0;
  if (odd)
    sum = x * x;
  vx_bar(0, 1);
  vx_mscratch_set(vx_mscratch() + vx_vote_all(sum));
}

// WARN: barriers.c:[[#@LINE+1]]:{{.*}}warning: a barrier that not all work-items of the group may reach
static __attribute__((noinline)) void different(void) {
  const uint lane = vx_thread_id();
  for (uint i = lane; i < 40; i += 16)
    // LINE: barriers.c:[[#@LINE+1]]:5: warning: a barrier that not all work-items of the group may reach: the condition in line [[#@LINE-1]] depends on the work-item's id
    meet();
}

int main(void) {
  same(7);
#ifndef AGREE
  different();
#else
  (void)different;
#endif
  return 0;
}
