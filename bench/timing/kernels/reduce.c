/* Sums of 256 products each, as a tree in local memory whose steps have ever
   fewer lanes. Warps have 64 bytes each. */
#include "kernel.h"

RESULT(float, 256);

int main(void) {
  const uint lane = vx_thread_id();
  volatile float *sums = (volatile float *)LOCAL + vx_warp_id() * LANES;
  FOR_WARPS(base, 256) {
    float sum = 0;
#pragma nounroll
    for (uint n = 0; n < 256; n += LANES)
      sum = __builtin_fmaf(ones[base + n + lane], ones[2048 + n + lane], sum);
    sums[lane] = sum;
#pragma nounroll
    for (uint width = LANES / 2; width > 0; width /= 2)
      if (lane < width)
        sums[lane] = sums[lane] + sums[lane + width];
    result[base + lane] = sums[0];
  }
  return 0;
}
