/* As nearest.c, with each point in a line. */
#include "kernel.h"

RESULT(float, 2048);

int main(void) {
  const uint lane = vx_thread_id();
  FOR_WARPS(base, 128) {
    const float *point = ones + 16 * (base + lane), *place = ones;
    const float x = point[0], y = point[1];
    float best = 9;
    uint which = 0;
#pragma nounroll
    for (uint n = 0; n < 32; ++n, place += 16) {
      const float dx = x - place[2], dy = y - place[3];
      const float distance = __builtin_sqrtf(dx * dx + dy * dy);
      if (distance < best) {
        best = distance;
        which = n;
      }
    }
    result[16 * (base + lane)] = best;
    result[16 * (base + lane) + 1] = (float)which;
  }
  return 0;
}
