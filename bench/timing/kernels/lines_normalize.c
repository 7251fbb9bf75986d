/* Five vectors of a line each get the length 1: a square root and divisions. */
#include "kernel.h"

RESULT(float, 4096);

int main(void) {
  const uint lane = vx_thread_id();
  FOR_WARPS(base, 256) {
    const float *in = ones + 16 * (base + lane);
    float *out = result + 16 * (base + lane);
#pragma nounroll
    for (uint n = 0; n < 15; n += 3) {
      const float x = in[n], y = in[n + 1], z = in[n + 2];
      const float length = __builtin_sqrtf(x * x + y * y + z * z);
      out[n] = x / length;
      out[n + 1] = y / length;
      out[n + 2] = z / length;
    }
  }
  return 0;
}
