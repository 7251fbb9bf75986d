/* Of 32 places the nearest to each of 128 points, by distance. */
#include "kernel.h"

RESULT(float, 256);

int main(void) {
  const uint lane = vx_thread_id();
  FOR_WARPS(base, 128) {
    const uint i = base + lane;
    float best = 9;
    uint which = 0;
#pragma nounroll
    for (uint n = 0; n < 32; ++n) {
      const float dx = ones[i] - ones[1024 + n];
      const float dy = ones[512 + i] - ones[1536 + n];
      const float distance = __builtin_sqrtf(dx * dx + dy * dy);
      if (distance < best) {
        best = distance;
        which = n;
      }
    }
    result[i] = best;
    result[128 + i] = (float)which;
  }
  return 0;
}
