/* Polynomials of degree 15 at eight places each: a line of coefficients, chains
   of fused multiplications and additions. */
#include "kernel.h"

RESULT(float, 2048);

int main(void) {
  const uint lane = vx_thread_id();
  FOR_WARPS(base, 128) {
    const float *of = ones + 16 * (base + lane);
#pragma nounroll
    for (uint p = 0; p < 8; p += 2) {
      const float x = ones[3000 + p] - 1.0f, y = ones[3001 + p] - 1.0f;
      float at_x = 0, at_y = 0;
#pragma nounroll
      for (uint n = 0; n < 16; ++n) {
        at_x = __builtin_fmaf(at_x, x, of[n]);
        at_y = __builtin_fmaf(at_y, y, of[n]);
      }
      result[16 * (base + lane) + p] = at_x;
      result[16 * (base + lane) + p + 1] = at_y;
    }
  }
  return 0;
}
