// Blending by the rasterizers: every core starts the tile commands that are its
// own and waits for them at the end, or in a later kernel (docs/rasterizer.md).
// One group a core.

// Training: pixels keep their last contributor.
#pragma vorion choice flag KEEP_LAST
// Dealing by the last frame: tiles keep their counts.
#pragma vorion choice flag KEEP_COUNTS
// Tiles are drawn in depth parts (effects/ZTiles.cpp).
#pragma vorion choice effect USE_ZTILES
// Pixel units end what rasterizers hand over (effects/PixelUnit.cpp).
#pragma vorion choice effect USE_PIXEL_UNIT
// Pixels have limits, where a mesh hides what is behind (effects/Mesh.cpp).
#pragma vorion choice effect USE_MESH
// Surfaces lie between Gaussians, so lists are drawn range after range
// (effects/Mesh.cpp).
#pragma vorion choice effect USE_LAYERS

#include "layout.h"
#include "tile.h"
#include "window.h"
#ifdef KEEP_COUNTS
#include "deal_last_frame.cl"
#else
#include "deal.cl"
#endif

#include <vorion_raster.h>

_Static_assert(sizeof(splat_gaussian) == sizeof(vx_gaussian) &&
                   sizeof(splat_ray_gaussian) == sizeof(vx_ray_gaussian),
               "kernels/layout.h and docs/isa.md disagree");
_Static_assert(SPANS_TILES == VR_INTERSECT,
               "kernels/layout.h and docs/isa.md disagree");
_Static_assert(DATAPATH_EXP == VR_OPTIONS_EXP_SHIFT &&
                   DATAPATH_STOP_AT_EQUAL == VR_OPTIONS_STOP_AT_EQUAL_MASK &&
                   DATAPATH_SKIP_SATURATED == VR_OPTIONS_SKIP_SATURATED_MASK &&
                   DATAPATH_BLEND == VR_OPTIONS_BLEND_SHIFT &&
                   DATAPATH_ALPHA_CUTOFF == VR_OPTIONS_ALPHA_CUTOFF_SHIFT &&
                   DATAPATH_DEGREE4 == VR_OPTIONS_DEGREE4_MASK &&
                   DATAPATH_LOW_PASS == VR_OPTIONS_LOW_PASS_MASK,
               "kernels/layout.h and docs/isa.md disagree");
_Static_assert(sizeof(vx_tail) == TAIL_BYTES &&
                   sizeof(vx_tail_range) == TAIL_RANGE_BYTES,
               "kernels/layout.h and docs/isa.md disagree");

// From a hand-over record to the next.
#if USE_MESH
#define TAIL_STRIDE (TAIL_BYTES + TAIL_RANGE_BYTES)
#else
#define TAIL_STRIDE TAIL_BYTES
#endif

// What the commands of a picture share.
typedef struct {
  // Addresses; `last` is that of the tiles' counts with KEEP_COUNTS.
  __global const splat_record *records;
  uint list, output, last, tails;
  splat_blend_options o;
#if USE_MESH
  uint limits; // of the pixels' ranges
#endif
#if USE_LAYERS
  uint froms;                          // their beginnings
  __global const uint *tile_layers;    // the most that a pixel of a tile has
  uint layer;                          // number of the range
#endif
} picture_commands;

// Starts depth part `part` of tile `tile`, whose list is `range`; `job` numbers
// the hand-over records.
static void start_part(const picture_commands *c, uint tile, uint part,
                       uint2 range, uint job) {
  const uint effects = c->o.effects;
  const uint x = tile % c->o.tiles_x * TILE_SIZE;
  const uint y = tile / c->o.tiles_x * TILE_HEIGHT;
  uint begin = 0, count = range.y - range.x;
  uint first_pixel = y * c->o.size[0] + x;
  if (USE_ZTILES) {
    const uint parts = c->o.parts;
    const uint entries = count;
    begin = entries * part / parts;
    count = entries * (part + 1) / parts - begin;
    first_pixel += part * c->o.size[1] * c->o.size[0];
    vr_ztile_set(part | parts << VR_ZTILE_COUNT_SHIFT);
  }
  if (USE_PIXEL_UNIT) {
    vr_tail_count_set(max(c->o.tail_count,
                          count * c->o.tail_last[0] / c->o.tail_last[1]));
    vr_tail_record_set(c->tails + job * (uint)TAIL_STRIDE);
  }
  const tile_place at = place_of_tile(c->records, x, y);
#if USE_WINDOWS
  vr_gaussians_set((uint)at.records);
#endif
#ifdef KEEP_COUNTS
  vx_raster_keep_counts(c->last + tile * (uint)sizeof(uint2));
#endif
#ifdef KEEP_LAST
  vx_raster_keep_last(c->last + first_pixel * (uint)sizeof(uint));
#endif
#if USE_RAYS
  vx_raster_rays();
#endif
#if USE_MESH
  vx_raster_limit(c->limits + (y * c->o.size[0] + x) * (uint)sizeof(uint),
                  begin);
#endif
#if USE_LAYERS
  if (c->layer != 0)
    vx_raster_from(c->froms + first_pixel * (uint)sizeof(uint));
  vx_raster_sequence(c->layer != 0, c->layer < c->tile_layers[tile]);
#endif
  vx_raster_render(c->list + (range.x + begin) * (uint)sizeof(uint), count,
                   at.x, at.y, min((uint)TILE_SIZE, c->o.size[0] - x),
                   min((uint)TILE_HEIGHT, c->o.size[1] - y),
                   c->output + first_pixel * (uint)sizeof(float4));
}

#if USE_LAYERS
static uint pixels_of(const splat_blend_options *o) {
  return o->size[0] * o->size[1];
}
#endif

// Jobs are (tile, part), tiles by `tile_order`, the parts of a tile together.
// `pixels` has `parts` pictures.
static void start_jobs(__global const splat_record *records,
                       __global const uint *list, __global const uint2 *ranges,
                       __global const uint *tile_order,
                       __global float4 *pixels, __global uint *last,
                       __global uint *tails,
#if USE_MESH
                       __global const uint *limits,
#endif
#if USE_LAYERS
                       __global const uint *tile_layers, uint layer,
#endif
                       splat_blend_options options) {
  const uint effects = options.effects;
  const uint parts = USE_ZTILES ? options.parts : 1;
  const uint jobs = options.tiles * parts;
  const picture_commands c = {records,    (uint)list,  (uint)pixels,
                              (uint)last, (uint)tails, options,
#if USE_LAYERS
                              // A plane of them for each range.
                              (uint)(limits + layer * pixels_of(&options)),
                              (uint)(limits + (layer - 1) *
                                                  pixels_of(&options)),
                              tile_layers,
                              layer
#elif USE_MESH
                              (uint)limits
#endif
  };
  vx_raster_setup((uint)records, options.cutoff, options.datapath,
                  options.size[0] * (uint)sizeof(float4));
  // Without the pixel unit: no reason to hand over, whatever ran before.
  vr_tail_count_set(0);
  vr_tail_share_set(USE_PIXEL_UNIT ? options.tail_share : 0);
#ifdef KEEP_COUNTS
  for (deal d = first_job(tile_order, jobs); d.job < d.end; d = next_job(d)) {
#else
  for (deal d = first_job(); d.job < jobs; d = next_job(d)) {
#endif
    const uint job = d.job;
    const uint tile = tile_order[job / parts];
#if USE_LAYERS
    if (layer > tile_layers[tile])
      continue;
#endif
    start_part(&c, tile, job % parts, ranges[tile], job);
  }
}

static void wait_for_jobs(__global uint *statuses) {
  const uint status = vr_wait();
  if (get_local_id(0) == 0)
    statuses[vx_core_id()] = status;
}

__kernel __attribute__((reqd_work_group_size(16, 1, 1))) void
rasterize(__global const splat_record *records, __global const uint *list,
          __global const uint2 *ranges, __global const uint *tile_order,
          __global float4 *pixels, __global uint *last, __global uint *tails,
#if USE_MESH
          __global const uint *limits,
#endif
#if USE_LAYERS
          __global const uint *tile_layers, uint layer,
#endif
          __global uint *statuses, splat_blend_options options) {
  start_jobs(records, list, ranges, tile_order, pixels, last, tails,
#if USE_MESH
             limits,
#endif
#if USE_LAYERS
             tile_layers, layer,
#endif
             options);
  wait_for_jobs(statuses);
}

// The two halves of that: between them other kernels may run, while the
// rasterizers and pixel units work.
__kernel __attribute__((reqd_work_group_size(16, 1, 1))) void
rasterize_start(__global const splat_record *records,
                __global const uint *list, __global const uint2 *ranges,
                __global const uint *tile_order, __global float4 *pixels,
                __global uint *last, __global uint *tails,
#if USE_MESH
                __global const uint *limits,
#endif
#if USE_LAYERS
                __global const uint *tile_layers, uint layer,
#endif
                splat_blend_options options) {
  start_jobs(records, list, ranges, tile_order, pixels, last, tails,
#if USE_MESH
             limits,
#endif
#if USE_LAYERS
             tile_layers, layer,
#endif
             options);
}

__kernel __attribute__((reqd_work_group_size(16, 1, 1))) void
rasterize_wait(__global uint *statuses) {
  wait_for_jobs(statuses);
}
