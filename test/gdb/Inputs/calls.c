// Functions for the debugger to call while the odd lanes stand in one of them.
#include <vorion.h>

unsigned results[16], called;

__attribute__((noinline)) unsigned square(unsigned x) { return x * x; }
__attribute__((noinline, used)) float half(float x) { return x * 0.5f; }
__attribute__((noinline, used)) unsigned peek(volatile unsigned *where) {
  return *where;
}
__attribute__((noinline, used)) unsigned add(unsigned by) {
  return __atomic_add_fetch(&called, by, __ATOMIC_RELAXED);
}

int main(void) {
  unsigned lane = vx_thread_id(), sum = lane;
  if (lane % 2)
    sum += square(lane);
  results[lane] = sum;
  // What the debugger did must not show.
  return results[lane] != (lane % 2 ? lane + lane * lane : lane);
}
