/* As ranksort.c, with each word in a line. */
#include "kernel.h"

RESULT(uint, 1024);

int main(void) {
  const uint lane = vx_thread_id();
  FOR_WARPS(base, 64) {
    const uint own = bits[16 * (base + lane)];
    uint rank = 0;
#pragma nounroll
    for (uint n = 0; n < 64; ++n)
      rank += bits[16 * n] < own || (bits[16 * n] == own && n < base + lane);
    result[16 * rank] = own;
  }
  return 0;
}
