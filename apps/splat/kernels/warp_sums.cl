// Sums of a warp's pixels, so that only one work-item of it adds each to memory:
// the idea of DISTWAR (Durvasula et al. 2024) and of gsplat's warpSum. Lanes
// exchange by local memory, which takes fewer instructions than shuffles: a
// store a sum, then each lane adds up one sum.
#pragma once

#include "atomic_sum.cl"
#include "lane_tree.cl"
#include "pixel_backward.cl"

#include <vorion.h>

_Static_assert(ALL_SUMS <= LANES, "a lane has at most one sum");

// Sums by lane. The column that is too many lets both ways meet all banks.
typedef float warp_parts[ALL_SUMS][LANES + 1];

// All lanes of a warp come here, each with what its pixel has of one Gaussian.
// `to`: the Gaussian's place in the first of the planes of `count` sums.
static void add_of_warp(__local warp_parts *parts, bool has, const float *sum,
                        __global float *to, uint count) {
  if (!vx_vote_any(has))
    return;
  const uint lane = vx_thread_id();
  // In a loop the sums would lie on the stack.
#pragma unroll
  for (uint k = 0; k < ALL_SUMS; ++k)
    (*parts)[k][lane] = sum[k];
  sub_group_barrier(CLK_LOCAL_MEM_FENCE);
  if (lane < ALL_SUMS)
    atomic_sum(to + lane * count, sum_of_lanes((*parts)[lane]));
}
