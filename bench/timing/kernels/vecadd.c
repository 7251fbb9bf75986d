/* The sum of two vectors: nothing but memory. */
#include "kernel.h"

RESULT(float, 2048);

int main(void) {
  const uint lane = vx_thread_id();
  FOR_WARPS(base, 2048)
  result[base + lane] = ones[base + lane] + ones[2048 + base + lane];
  return 0;
}
