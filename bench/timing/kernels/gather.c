/* A sparse matrix times a vector: a lane has a row, rows are of different
   lengths, and their elements' columns are anywhere. */
#include "kernel.h"

RESULT(float, 256);

int main(void) {
  const uint lane = vx_thread_id();
  FOR_WARPS(base, 256) {
    const uint row = base + lane, length = bytes[row] % 16;
    float sum = 0;
#pragma nounroll
    for (uint n = 0; n < length; ++n)
      sum = __builtin_fmaf(ones[1024 + 4 * row + n], ones[bits[row + n] % 1024],
                           sum);
    result[row] = sum;
  }
  return 0;
}
