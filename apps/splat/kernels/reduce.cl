// A Gaussian's sums over its tiles, which lie side by side in the order of the
// tiles. Each partial sum keeps what rounding takes from it (T. J. Dekker 1971):
// hundreds of tiles lose no more than one. Without atomics, in a fixed order.

// So many sums of absolute gradients are taken, too.
#pragma vorion choice optional uint ABSOLUTE_SUMS

#include "activate.cl"
#include "layout.h"
#include "record.h"

#ifdef ABSOLUTE_SUMS
#define ALL_SUMS (RECORD_SUMS + ABSOLUTE_SUMS)
#else
#define ALL_SUMS RECORD_SUMS
#endif

__kernel void reduce_sums(__global const float *pair_sums,
                          __global const uint *order,
                          __global const uint *offsets,
                          __global float *sums, uint seen, uint count) {
  const uint i = get_global_id(0);
  if (i >= seen)
    return;
  const uint gaussian = order[i];
  const uint end = offsets[i + 1];
  for (uint k = 0; k < ALL_SUMS; ++k) {
    float2 total = (float2)(0.0f, 0.0f);
    for (uint place = offsets[i]; place < end; ++place) {
      const float2 next = two_sum(total.x, pair_sums[place * ALL_SUMS + k]);
      total = (float2)(next.x, total.y + next.y);
    }
    sums[k * count + gaussian] = total.x + total.y;
  }
}
