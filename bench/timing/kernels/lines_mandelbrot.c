/* Steps of z = z^2 + c for 128 points: lanes whose z has left count no more. */
#include "kernel.h"

RESULT(uint, 2048);

int main(void) {
  const uint lane = vx_thread_id();
  FOR_WARPS(base, 128) {
    const float *point = ones + 16 * (base + lane);
    const float cx = 3.0f * point[0] - 5.0f, cy = 2.0f * point[1] - 3.0f;
    float x = 0, y = 0;
    uint count = 0;
#pragma nounroll
    for (uint n = 0; n < 32; ++n) {
      const float xx = x * x, yy = y * y;
      if (xx + yy < 4) {
        y = 2.0f * x * y + cy;
        x = xx - yy + cx;
        ++count;
      }
    }
    result[16 * (base + lane)] = count;
  }
  return 0;
}
