/* A matrix of 128 rows of 16 times vectors: a row is a line. */
#include "kernel.h"

RESULT(float, 2048);

int main(void) {
  const uint lane = vx_thread_id();
  FOR_WARPS(base, 128) {
    const float *row = ones + 16 * (base + lane);
#pragma nounroll
    for (uint v = 0; v < 4; ++v) {
      const float *vector = ones + 2048 + 16 * v;
      float sum = 0;
#pragma nounroll
      for (uint n = 0; n < 16; ++n)
        sum = __builtin_fmaf(row[n], vector[n], sum);
      result[16 * (base + lane) + v] = sum;
    }
  }
  return 0;
}
