// Blending's way back by the cores alone as INRIA's program has it (Kerbl et al.
// 2023): a work-item a pixel goes through the tile's list from its end, in
// batches that lie in local memory, and adds what each Gaussian gets to the
// Gaussian's sums in memory, by atomics. It is there to be measured: what the
// paper's rasterizer is compared with are kernels that sum so. WARP_SUMS: the
// pixels of a warp are added up first (warp_sums.cl).

// The exponent below which no opacity is visible.
#pragma vorion choice float MIN_POWER
// The pixels of a warp are added up first (warp_sums.cl).
#pragma vorion choice flag WARP_SUMS

#define RECORD_SPACE __local // pixel_backward.cl

#include "atomic_sum.cl"
#include "layout.h"
#include "pixel_backward.cl"
#include "tile.h"
#include "window.h"
#ifdef WARP_SUMS
#include "warp_sums.cl"
#endif

// As many as blend.cl has.
#define BATCH 64
#define TILE_PIXELS (TILE_SIZE * TILE_SIZE)

// One Gaussian in one pixel at (px, py), if it is `listed` there: adds to `sum`.
// False where the pixel has nothing of the Gaussian.
static bool in_pixel(bool listed, __local const splat_gaussian *g, float px,
                     float py, __local const float4 *gradient,
                     __local float2 *state, float *sum) {
  const float dx = g->mean[0] - px, dy = g->mean[1] - py;
  const float power =
      -0.5f * (g->conic[0] * dx * dx + g->conic[2] * dy * dy) -
      g->conic[1] * dx * dy;
  if (!listed | (fabs(dx) > g->extent[0]) | (fabs(dy) > g->extent[1]) |
      !((power <= 0.0f) & (power >= MIN_POWER)))
    return false;
  return pixel_backward(g, (float2)(dx, dy), power, gradient, state, sum);
}

__kernel __attribute__((reqd_work_group_size(TILE_PIXELS, 1, 1))) void
blend_backward_atomics(__global const splat_gaussian *records,
                       __global const uint *list, __global const uint2 *ranges,
                       __global const float4 *pixels,
                       __global const uint *last,
                       __global const float4 *upstream, __global float *sums,
                       uint count, uint width, uint height) {
  __local splat_gaussian batch[BATCH];
  __local uint gaussians[BATCH];
  __local float4 gradient[TILE_PIXELS];
  __local float2 state[TILE_PIXELS];
#ifdef WARP_SUMS
  __local warp_parts parts;
#endif

  const uint item = get_local_id(0);
  const uint x0 = get_group_id(0) * TILE_SIZE;
  const uint y0 = get_group_id(1) * TILE_SIZE;
  const uint x = x0 + item % TILE_SIZE, y = y0 + item / TILE_SIZE;
  const uint2 range =
      ranges[get_group_id(1) * get_num_groups(0) + get_group_id(0)];
  const bool inside = x < width && y < height;
  const uint i = inside ? y * width + x : 0;
  const uint own_last = inside ? last[i] : 0;
  gradient[item] = upstream[i];
  state[item] = (float2)(pixels[i].w, upstream[i].w);
  const tile_place tile = place_of_tile(records, x0, y0);
  const float px = (float)(tile.x + item % TILE_SIZE) + 0.5f;
  const float py = (float)(tile.y + item / TILE_SIZE) + 0.5f;

  for (uint left = range.y - range.x; left != 0;) {
    const uint entries = min((uint)BATCH, left);
    for (uint e = item; e < entries; e += TILE_PIXELS) {
      gaussians[e] = list[range.x + left - 1 - e] & ~SPANS_TILES;
      batch[e] = tile.records[gaussians[e]];
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    for (uint e = 0; e < entries; ++e) {
      float sum[ALL_SUMS] = {0.0f};
#ifdef WARP_SUMS
      const bool listed = left - 1 - e < own_last;
      // The warp as a whole: lanes would have to part and meet again.
      if (!vx_vote_any(listed))
        continue;
      const bool has = in_pixel(listed, &batch[e], px, py, gradient + item,
                                state + item, sum);
      add_of_warp(&parts, has, sum, sums + gaussians[e], count);
#else
      if (left - 1 - e >= own_last ||
          !in_pixel(true, &batch[e], px, py, gradient + item, state + item,
                    sum))
        continue;
      for (uint k = 0; k < ALL_SUMS; ++k)
        atomic_sum(sums + k * count + gaussians[e], sum[k]);
#endif
    }
    // Nobody may refill the batch before all have gone through it.
    barrier(CLK_LOCAL_MEM_FENCE);
    left -= entries;
  }
}

__kernel void clear_sums(__global float *sums, uint words) {
  const uint i = get_global_id(0);
  if (i < words)
    sums[i] = 0.0f;
}
