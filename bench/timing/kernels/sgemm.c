/* The product of two matrices of 32 x 32: a lane has an element. */
#include "kernel.h"

enum { SIZE = 32 };
RESULT(float, 1024);

int main(void) {
  const uint lane = vx_thread_id();
  FOR_WARPS(base, SIZE * SIZE) {
    const float *row = ones + base / SIZE * SIZE;
    const float *column = ones + SIZE * SIZE + base % SIZE + lane;
    float sum = 0;
#pragma nounroll
    for (uint k = 0; k < SIZE; ++k)
      sum = __builtin_fmaf(row[k], column[k * SIZE], sum);
    result[base + lane] = sum;
  }
  return 0;
}
