/* Sums of digits to several bases: integer divisions. */
#include "kernel.h"

RESULT(uint, 1024);

int main(void) {
  const uint lane = vx_thread_id();
  FOR_WARPS(base, 64) {
#pragma nounroll
    for (uint b = 0; b < 4; ++b) {
      const uint to = bytes[b] + 2;
      uint rest = bits[16 * (base + lane) + b], sum = 0;
#pragma nounroll
      for (uint n = 0; n < 8; ++n) {
        sum += rest % to;
        rest /= to;
      }
      result[16 * (base + lane) + b] = sum;
    }
  }
  return 0;
}
