// Blending's way back by the cores alone: 16 work-items go through a tile's list
// from its end. Each owns every 16th pixel; 16 Gaussians at a time are summed
// over the work-items, one Gaussian a work-item, in a fixed order and without
// atomics.

// The exponent below which no opacity is visible.
#pragma vorion choice float MIN_POWER

#define RECORD_SPACE __global // pixel_backward.cl

#include "lane_tree.cl"
#include "layout.h"
#include "pixel_backward.cl"
#include "tile.h"
#include "window.h"

#define PIXELS (TILE_SIZE * TILE_SIZE)
#define OWN (PIXELS / LANES)

// One Gaussian in all pixels of this work-item: adds to `sum`.
static void through(__global const splat_record *g, uint entry, uint x0,
                    uint y0, __local const float4 *gradient,
                    __local float2 *state, __local const uint *last,
                    float *sum) {
  const uint lane = get_local_id(0);
#if USE_RAYS
  for (uint k = 0; k < OWN; ++k) {
    const uint place = k * LANES + lane;
    const float x = FROM_PIXEL(g, (float)(x0 + place % TILE_SIZE) + 0.5f, 0);
    const float y = FROM_PIXEL(g, (float)(y0 + place / TILE_SIZE) + 0.5f, 1);
    const ray_meeting at = meet(g, x, y);
    const float power = power_of(at);
    if ((last[place] > entry) & IN_BOX(g, x, y) & (power <= 0.0f) &
        (power >= MIN_POWER))
      pixel_backward(g, at, power, gradient + place, state + place, sum);
  }
#else
  const float mean_x = g->mean[0], mean_y = g->mean[1];
  const float a = g->conic[0], b = g->conic[1], c = g->conic[2];
  const float extent_x = g->extent[0], extent_y = g->extent[1];
  for (uint k = 0; k < OWN; ++k) {
    const uint place = k * LANES + lane;
    const float dx = mean_x - ((float)(x0 + place % TILE_SIZE) + 0.5f);
    const float dy = mean_y - ((float)(y0 + place / TILE_SIZE) + 0.5f);
    const float power = -0.5f * (a * dx * dx + c * dy * dy) - b * dx * dy;
    if ((last[place] > entry) & (fabs(dx) <= extent_x) &
        (fabs(dy) <= extent_y) & (power <= 0.0f) & (power >= MIN_POWER))
      pixel_backward(g, (float2)(dx, dy), power, gradient + place,
                     state + place, sum);
  }
#endif
}

__kernel __attribute__((reqd_work_group_size(LANES, 1, 1))) void
blend_backward(__global const splat_record *records,
               __global const uint *list, __global const uint2 *ranges,
               __global const float4 *pixels, __global const uint *last,
               __global const float4 *upstream, __global const uint *places,
               __global float *sums, uint width, uint height) {
  __local float4 gradient[PIXELS];
  __local float2 state[PIXELS];
  __local uint entries[PIXELS];
  __local float parts[LANES][ALL_SUMS][LANES]; // [Gaussian][sum][work-item]
  __local uint most[LANES];

  const uint lane = get_local_id(0);
  const uint x0 = get_group_id(0) * TILE_SIZE;
  const uint y0 = get_group_id(1) * TILE_SIZE;
  const uint2 range =
      ranges[get_group_id(1) * get_num_groups(0) + get_group_id(0)];
  const tile_place tile = place_of_tile(records, x0, y0);
  uint own_most = 0;
  for (uint k = 0; k < OWN; ++k) {
    const uint place = k * LANES + lane;
    const uint x = x0 + place % TILE_SIZE, y = y0 + place / TILE_SIZE;
    const bool inside = x < width && y < height;
    const uint i = inside ? y * width + x : 0;
    gradient[place] = upstream[i];
    state[place] = (float2)(pixels[i].w, upstream[i].w);
    entries[place] = inside ? last[i] : 0;
    own_most = max(own_most, entries[place]);
  }
  most[lane] = own_most;
  barrier(CLK_LOCAL_MEM_FENCE);
  uint left = 0;
  for (uint k = 0; k < LANES; ++k)
    left = max(left, most[k]);

  for (uint i = range.x + left + lane; i < range.y; i += LANES)
    for (uint k = 0; k < ALL_SUMS; ++k)
      sums[places[i] * ALL_SUMS + k] = 0.0f;
  while (left != 0) {
    const uint first = (left - 1) / LANES * LANES;
    for (uint entry = left; entry-- > first;) {
      float sum[ALL_SUMS] = {0.0f};
      through(tile.records + (list[range.x + entry] & ~SPANS_TILES), entry,
              tile.x, tile.y, gradient, state, entries, sum);
      for (uint k = 0; k < ALL_SUMS; ++k)
        parts[entry - first][k][lane] = sum[k];
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    if (first + lane < left) {
      __global float *to = sums + places[range.x + first + lane] * ALL_SUMS;
      for (uint k = 0; k < ALL_SUMS; ++k)
        to[k] = sum_of_lanes(parts[lane][k]);
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    left = first;
  }
}
