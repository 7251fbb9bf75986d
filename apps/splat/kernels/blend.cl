// Blending by the cores alone: a group of GROUP work-items draws a tile, each
// every GROUP-th pixel, with the rasterizer's arithmetic in the rasterizer's
// order (docs/abi.md). The list goes through local memory in batches, and the
// group stops when none of its pixels can change any more. The picture has the
// same bits for every TILE_SIZE and GROUP.
#pragma once

// Work-items of a group.
#pragma vorion choice uint GROUP
// Training: pixels keep their last contributor.
#pragma vorion choice flag KEEP_LAST
// Support: all tiles that INRIA's square meets.
#pragma vorion choice flag SUPPORT_OFFICIAL16
// Gaussians of several tiles are marked (effects/IntersectTags.cpp).
#pragma vorion choice effect USE_INTERSECT_TAGS
// Pixels have limits, where a mesh hides what is behind (effects/Mesh.cpp).
#pragma vorion choice effect USE_MESH
// Surfaces lie between Gaussians, so lists are drawn range after range
// (effects/Mesh.cpp).
#pragma vorion choice effect USE_LAYERS

#include "blend_rules.cl"
#include "layout.h"
#include "tile.h"
#include "window.h"

// Small, since a pixel that is done waits for the batch's end: letting lanes leave
// the loop one by one costs more, in instructions on trained scenes.
#define BATCH 64
// The 16 lanes of a pass draw 4x4 pixels: fewer boxes touch those than a row.
#define BLOCKS (TILE_SIZE / 4)
#define PLACE_X(place) ((place) / 16 % BLOCKS * 4 + (place) % 4)
#define PLACE_Y(place) ((place) / 16 / BLOCKS * 4 + (place) % 16 / 4)
#define TILE_PIXELS (TILE_SIZE * TILE_SIZE)
// Pixels of a work-item; the last items have none where the tile is smaller
// than the group.
#define OWN ((TILE_PIXELS + GROUP - 1) / GROUP)

// What spares a pixel the exponential. The official algorithm has neither: every
// pixel of a tile takes it for every Gaussian of the list that has a density
// there. Both leave the same pixels.
#ifdef SUPPORT_OFFICIAL16
#define IN_BOX(g, dx, dy) true
#define WORTH_TAKING(power) true
#define DENSITY(power) falloff(fmax(power, MIN_POWER))
#else
#define IN_BOX(g, dx, dy)                                                      \
  ((fabs(dx) <= (g)->extent[0]) & (fabs(dy) <= (g)->extent[1]))
#define WORTH_TAKING(power) IS_VISIBLE_POWER(power)
#define DENSITY(power) falloff(power)
#endif

// A list's entry without its tag.
#define GAUSSIAN(entry) ((entry) & (USE_INTERSECT_TAGS ? ~SPANS_TILES : ~0u))

#if USE_RAYS
#define RECORD_SPACE __local // ray_density.cl
#include "ray_density.cl"

static float power_at(__local const splat_record *g, float x, float y) {
  return power_of(meet(g, x, y));
}
#else
#define FROM_PIXEL(g, p, axis) ((g)->mean[axis] - (p))

// The exponent of a Gaussian's density, (dx, dy) from its mean.
static float power_at(__local const splat_record *g, float dx, float dy) {
  return -0.5f * (g->conic[0] * dx * dx + g->conic[2] * dy * dy) -
         g->conic[1] * dx * dy;
}
#endif

static float alpha_of(__local const splat_record *g, float power,
                      uint effects) {
  return clamped_alpha(g->opacity * DENSITY(power), effects);
}

typedef struct {
  float red, green, blue, transmittance;
  bool done; // takes no more
#ifdef KEEP_LAST
  uint last; // entries of the list up to the last one blended
#endif
#if USE_MESH
  uint limit; // number of the first entry that it does not take
#endif
#if USE_LAYERS
  uint from; // number of the first entry that it takes
  bool saturated;
#endif
} pixel_state;

// Blends the first `entries` of the batch, which is `before` entries behind the
// list's first, into the pixel with centre (px, py).
static pixel_state blend_batch(__local const splat_record *batch,
                               uint entries, uint before, float px, float py,
                               float cutoff, uint effects, pixel_state p) {
  for (uint j = 0; j < entries; ++j) {
    __local const splat_record *g = &batch[j];
#if USE_MESH
    p.done |= before + j >= p.limit;
#endif
    const float dx = FROM_PIXEL(g, px, 0);
    const float dy = FROM_PIXEL(g, py, 1);
#if USE_LAYERS
    if (before + j < p.from)
      continue;
#endif
    if (!p.done & IN_BOX(g, dx, dy)) {
      const float power = power_at(g, dx, dy);
      // False for NaN.
      if ((power <= 0.0f) & WORTH_TAKING(power)) {
        const float alpha = alpha_of(g, power, effects);
        const float next = p.transmittance * (1.0f - alpha);
        // Without branches: most Gaussians that get here are blended, and a
        // weight of 0 changes no bit.
        const bool visible = alpha >= ALPHA_CUTOFF / 255.0f;
        const bool full = visible & SATURATED(next);
        const bool blended = visible & !full;
        const float weight = blended ? alpha * p.transmittance : 0.0f;
        p.red += g->color[0] * weight;
        p.green += g->color[1] * weight;
        p.blue += g->color[2] * weight;
        p.transmittance = blended ? next : p.transmittance;
        p.done = full;
#if USE_LAYERS
        p.saturated |= full;
#endif
#ifdef KEEP_LAST
        p.last = blended ? before + j + 1 : p.last;
#endif
      }
    }
  }
  return p;
}

__kernel __attribute__((reqd_work_group_size(GROUP, 1, 1))) void
blend(__global const splat_record *records, __global const uint *list,
      __global const uint2 *ranges, __global float4 *pixels,
      __global uint *last,
#if USE_MESH
      __global const uint *limits,
#endif
#if USE_LAYERS
      __global const uint *tile_layers, uint layer,
#endif
      uint width, uint height, float cutoff, uint effects) {
  __local splat_record batch[BATCH];
  __local uint live;

  const uint item = get_local_id(0);
  const uint x0 = get_group_id(0) * TILE_SIZE;
  const uint y0 = get_group_id(1) * TILE_SIZE;
  const uint2 range = ranges[get_group_id(1) * get_num_groups(0) +
                             get_group_id(0)];

#if USE_LAYERS
  // The most layers that a pixel of the tile has.
  const uint most =
      tile_layers[get_group_id(1) * get_num_groups(0) + get_group_id(0)];
  if (layer > most)
    return;
  limits += layer * width * height; // a plane of them for each range
#endif
  const tile_place tile = place_of_tile(records, x0, y0);

  pixel_state own[OWN];
  for (uint k = 0; k < OWN; ++k) {
    const uint place = k * GROUP + item;
    const bool inside = place < TILE_PIXELS && x0 + PLACE_X(place) < width &&
                        y0 + PLACE_Y(place) < height;
    own[k] = (pixel_state){0.0f, 0.0f, 0.0f, 1.0f, !inside};
#if USE_MESH
    if (inside)
      own[k].limit = limits[(y0 + PLACE_Y(place)) * width + x0 + PLACE_X(place)];
#endif
#if USE_LAYERS
    if (inside && layer != 0) {
      const uint at = (y0 + PLACE_Y(place)) * width + x0 + PLACE_X(place);
      const float4 was = pixels[at];
      own[k].red = was.x;
      own[k].green = was.y;
      own[k].blue = was.z;
      own[k].transmittance = fabs(was.w);
      own[k].saturated = own[k].done = signbit(was.w);
      own[k].from = (limits - width * height)[at];
    }
#endif
  }
  bool group_live = true;
  for (uint base = range.x; base < range.y && group_live; base += BATCH) {
    const uint entries = min((uint)BATCH, range.y - base);
    if (item == 0)
      live = 0;
    for (uint e = item; e < entries; e += GROUP)
      batch[e] = tile.records[GAUSSIAN(list[base + e])];
    barrier(CLK_LOCAL_MEM_FENCE);

    bool open = false;
    for (uint k = 0; k < OWN; ++k) {
      const uint place = k * GROUP + item;
      const float px = (float)(tile.x + PLACE_X(place)) + 0.5f;
      const float py = (float)(tile.y + PLACE_Y(place)) + 0.5f;
      if (!own[k].done)
        own[k] = blend_batch(batch, entries, base - range.x, px, py, cutoff,
                             effects, own[k]);
      open |= !own[k].done;
    }
    if (open)
      atomic_or(&live, 1u);
    barrier(CLK_LOCAL_MEM_FENCE);
    group_live = live != 0;
    // Nobody may clear `live` or refill the batch before all have read it.
    barrier(CLK_LOCAL_MEM_FENCE);
  }
  for (uint k = 0; k < OWN; ++k) {
    const uint place = k * GROUP + item;
    const uint x = x0 + PLACE_X(place);
    const uint y = y0 + PLACE_Y(place);
    if (place < TILE_PIXELS && x < width && y < height) {
      float transmittance = own[k].transmittance;
#if USE_LAYERS
      // The next range has to know.
      if (own[k].saturated && layer < most)
        transmittance = -transmittance;
#endif
      pixels[y * width + x] =
          (float4)(own[k].red, own[k].green, own[k].blue, transmittance);
#ifdef KEEP_LAST
      last[y * width + x] = own[k].last;
#endif
    }
  }
}
