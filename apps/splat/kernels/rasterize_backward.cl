// Blending's way back by the rasterizers: every core starts the tiles that are
// its own, takes what is handed over, and stores it where the pairs of a
// Gaussian lie side by side (docs/rasterizer.md, "The backward mode").

#include "deal.cl"
#include "layout.h"
#include "record.h"
#include "tile.h"
#include "window.h"

#include <vorion_raster.h>

#if USE_RAYS
#define START_BACKWARD vx_raster_rays_backward
#else
#define START_BACKWARD vx_raster_backward
#endif

typedef struct {
  __global const splat_record *records;
  uint list, pixels, last, upstream; // addresses
  uint backward;                     // vr_backward
  splat_blend_options o;
} backward_commands;

static void start_tile(const backward_commands *c, uint tile, uint2 range) {
  const uint x = tile % c->o.tiles_x * TILE_SIZE;
  const uint y = tile / c->o.tiles_x * TILE_HEIGHT;
  const uint first = y * c->o.size[0] + x;
  const tile_place at = place_of_tile(c->records, x, y);
#if USE_WINDOWS
  vr_gaussians_set((uint)at.records);
#endif
  START_BACKWARD(c->list + range.x * (uint)sizeof(uint), range.y - range.x,
                 at.x, at.y, min((uint)TILE_SIZE, c->o.size[0] - x),
                 min((uint)TILE_HEIGHT, c->o.size[1] - y),
                 c->pixels + first * (uint)sizeof(float4),
                 c->last + first * (uint)sizeof(uint),
                 c->upstream + first * (uint)sizeof(float4), c->backward);
}

// Entries from `begin` on are behind everything that is seen.
static void store_nothing(__global const uint *places, __global float *sums,
                          uint begin, uint end) {
  for (uint slot = begin + get_local_id(0); slot < end; slot += VR_GRAD_LANES) {
    __global float *to = sums + places[slot] * RECORD_SUMS;
    for (uint k = 0; k < RECORD_SUMS; ++k)
      to[k] = 0.0f;
  }
}

// Stores the lane's Gaussian of the batch that was handed over.
static void store_lane(__global float *to) {
  to[SUM_COLOR] = as_float(vr_grad_r());
  to[SUM_COLOR + 1] = as_float(vr_grad_g());
  to[SUM_COLOR + 2] = as_float(vr_grad_b());
  to[SUM_S] = as_float(vr_grad_s());
  to[SUM_SX] = as_float(vr_grad_sx());
  to[SUM_SX + 1] = as_float(vr_grad_sy());
  to[SUM_SXX] = as_float(vr_grad_sxx());
  to[SUM_SXX + 1] = as_float(vr_grad_sxy());
  to[SUM_SXX + 2] = as_float(vr_grad_syy());
#if USE_RAYS
  for (uint k = SUM_UQ; k < RECORD_SUMS; ++k) {
    vr_index_set(1 + k); // behind the tag
    to[k] = as_float(vr_item());
  }
#endif
}

static void take_tile(uint2 range, __global const uint *places,
                      __global float *sums) {
  const uint lane = get_local_id(0);
  uint end = range.y; // of what has not been stored
  for (uint next = vr_grad_next(); next != 0; next = vr_grad_next()) {
    const uint count = next >> VR_GRAD_NEXT_COUNT_SHIFT & VR_GRAD_NEXT_COUNT_MASK;
    const uint begin =
        range.x + VR_GRAD_LANES * (next >> VR_GRAD_NEXT_BATCH_SHIFT);
    store_nothing(places, sums, begin + count, end);
    if (lane < count)
      store_lane(sums + places[begin + lane] * RECORD_SUMS);
    end = begin;
  }
  store_nothing(places, sums, range.x, end);
}

// A tile is started before what the one before it hands over is taken, so that
// the rasterizer always has a next one.
__kernel __attribute__((reqd_work_group_size(16, 1, 1))) void
rasterize_backward(__global const splat_record *records,
                   __global const uint *list, __global const uint2 *ranges,
                   __global const uint *tile_order,
                   __global const float4 *pixels, __global const uint *last,
                   __global const float4 *upstream,
                   __global const uint *places, __global float *sums,
                   __global uint *statuses, splat_blend_options options,
                   uint backward) {
  const backward_commands c = {records,    (uint)list,     (uint)pixels,
                               (uint)last, (uint)upstream, backward,
                               options};
  vx_raster_setup((uint)records, options.cutoff, options.datapath,
                  options.size[0] * (uint)sizeof(float4));
  vr_tail_count_set(0);
  vr_tail_share_set(0);
  uint2 before = (uint2)(0, 0);
  bool started = false;
  for (deal d = first_job(); d.job < options.tiles; d = next_job(d)) {
    const uint tile = tile_order[d.job];
    const uint2 range = ranges[tile];
    start_tile(&c, tile, range);
    if (started)
      take_tile(before, places, sums);
    before = range;
    started = true;
  }
  if (started)
    take_tile(before, places, sums);
  const uint status = vr_wait();
  if (get_local_id(0) == 0)
    statuses[vx_core_id()] = status;
}
