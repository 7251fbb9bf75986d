/* Sorts by counting, for each word, those that come before it. */
#include "kernel.h"

RESULT(uint, 128);

int main(void) {
  const uint lane = vx_thread_id();
  FOR_WARPS(base, 128) {
    const uint own = bits[base + lane];
    uint rank = 0;
#pragma nounroll
    for (uint n = 0; n < 128; ++n)
      rank += bits[n] < own || (bits[n] == own && n < base + lane);
    result[rank] = own;
  }
  return 0;
}
