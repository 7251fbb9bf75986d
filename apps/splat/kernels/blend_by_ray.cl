// Blending by the cores alone, each pixel in the order of depths along its own
// ray, with blend.cl's arithmetic. A tile's list has the order of the centres'
// depths. In trained scenes 13 to 33 % of the pairs that a pixel blends have the
// other order along its ray (docs/numerics.md). So a pixel goes through the list
// several times. Each time it finds the RAY_WINDOW nearest Gaussians behind
// those that it has blended. The picture has the same bits for every RAY_WINDOW.

// Gaussians that a pixel finds at once.
#pragma vorion choice uint RAY_WINDOW

#include "blend.cl"

#if USE_MESH
#include <vorion.h>
#endif

// The nearest Gaussian comes first. Empty places have alpha 0.
typedef struct {
  float depth[RAY_WINDOW], alpha[RAY_WINDOW];
  uint entry[RAY_WINDOW]; // of the list
} ray_window;

// How far along the ray (slope.x, slope.y, 1) the density is largest.
static float ray_depth(__local const splat_ray_frame *f, float2 slope) {
  float along = 0.0f, square = 0.0f;
#pragma unroll
  for (int k = 0; k < 3; ++k) {
    const float r =
        f->across[k] * slope.x + f->down[k] * slope.y + f->ahead[k];
    along += r * f->mean[k];
    square += r * r;
  }
  // A number in any case, so that each has a place in the order.
  const float largest = 0x1.fffffep127f; // of floats
  return fmin(fmax(along / square, -largest), largest);
}

// Puts a Gaussian behind those that are as near, in place of the farthest.
static void insert(ray_window *w, float depth, float alpha, uint entry) {
  bool before = false;
#pragma unroll
  for (int k = 0; k < RAY_WINDOW; ++k) {
    const float d = w->depth[k], a = w->alpha[k];
    const uint e = w->entry[k];
    before |= depth < d;
    w->depth[k] = before ? depth : d;
    w->alpha[k] = before ? alpha : a;
    w->entry[k] = before ? entry : e;
    depth = before ? d : depth;
    alpha = before ? a : alpha;
    entry = before ? e : entry;
  }
}

static pixel_state blend_entry(__global const splat_gaussian *records,
                               __global const uint *list, uint entry,
                               float alpha, float cutoff, uint effects,
                               pixel_state p) {
  const float next = p.transmittance * (1.0f - alpha);
  // An empty place: the list has nothing more.
  p.done = (alpha == 0.0f) | SATURATED(next);
#if USE_LAYERS
  p.saturated |= p.done & (alpha != 0.0f);
#endif
  if (!p.done) {
    __global const splat_gaussian *g = &records[GAUSSIAN(list[entry])];
    const float weight = alpha * p.transmittance;
    p.red += g->color[0] * weight;
    p.green += g->color[1] * weight;
    p.blue += g->color[2] * weight;
    p.transmittance = next;
  }
  return p;
}

#if USE_MESH
// Where the rays of a pinhole meet a mesh: depths are those along them, too.
static float surface_depth(uint2 seen) {
  return seen.y == VR_NO_PRIMITIVE ? INFINITY : 1.0f / as_float(seen.x);
}
#endif

__kernel __attribute__((reqd_work_group_size(GROUP, 1, 1))) void
blend_by_ray(__constant const splat_view *view,
             __global const splat_gaussian *records,
             __global const splat_ray_frame *frames, __global const uint *list,
             __global const uint2 *ranges, __global float4 *pixels,
#if USE_MESH
             __global const uint2 *visible,
#endif
#if USE_LAYERS
             __global const uint2 *layers, __global const uint *layer_counts,
             __global const uint *tile_layers, uint layer,
#endif
             float cutoff, uint effects) {
  __local splat_gaussian batch[BATCH];
  __local splat_ray_frame frame[BATCH];
  __local uint live;

  const uint item = get_local_id(0);
  const uint x0 = get_group_id(0) * TILE_SIZE;
  const uint y0 = get_group_id(1) * TILE_SIZE;
  const uint2 range = ranges[get_group_id(1) * get_num_groups(0) +
                             get_group_id(0)];
#if USE_LAYERS
  const uint most =
      tile_layers[get_group_id(1) * get_num_groups(0) + get_group_id(0)];
  if (layer > most)
    return;
#endif
  const tile_place tile = place_of_tile(records, x0, y0);
  // A work-item's pixels one after the other: its window is in registers.
  for (uint k = 0; k < OWN; ++k) {
    const uint place = k * GROUP + item;
    const uint x = x0 + PLACE_X(place), y = y0 + PLACE_Y(place);
    const bool inside =
        place < TILE_PIXELS && x < view->size[0] && y < view->size[1];
    const float2 slope =
        (float2)((((float)x + 0.5f) - view->center[0]) / view->focal[0],
                 (((float)y + 0.5f) - view->center[1]) / view->focal[1]);
    const float px = (float)(tile.x + PLACE_X(place)) + 0.5f;
    const float py = (float)(tile.y + PLACE_Y(place)) + 0.5f;
    pixel_state p = {0.0f, 0.0f, 0.0f, 1.0f, !inside};
#if USE_MESH
    const uint at = inside ? y * view->size[0] + x : 0;
    float nearest = -INFINITY, farthest = surface_depth(visible[at]);
#endif
#if USE_LAYERS
    const uint pixel_count = view->size[0] * view->size[1];
    const uint own = layer_counts[at];
    if (layer < own)
      farthest = surface_depth(layers[layer * pixel_count + at]);
    if (inside && layer != 0) {
      const float4 was = pixels[at];
      p.red = was.x;
      p.green = was.y;
      p.blue = was.z;
      p.transmittance = fabs(was.w);
      p.saturated = signbit(was.w);
      p.done = p.saturated | (layer > own);
      if (layer <= own)
        nearest = surface_depth(layers[(layer - 1) * pixel_count + at]);
    }
#endif
    float last_depth = -INFINITY;
    uint last_entry = 0;
    for (bool group_live = true; group_live;) {
      ray_window window;
#pragma unroll
      for (int w = 0; w < RAY_WINDOW; ++w) {
        window.depth[w] = INFINITY;
        window.alpha[w] = 0.0f;
        window.entry[w] = 0;
      }
      for (uint base = range.x; base < range.y; base += BATCH) {
        const uint entries = min((uint)BATCH, range.y - base);
        for (uint e = item; e < entries; e += GROUP) {
          const uint i = GAUSSIAN(list[base + e]);
          batch[e] = tile.records[i];
          frame[e] = frames[i];
        }
        barrier(CLK_LOCAL_MEM_FENCE);
        for (uint j = 0; j < entries; ++j) {
          __local const splat_gaussian *g = &batch[j];
          const float dx = g->mean[0] - px;
          const float dy = g->mean[1] - py;
          if (!p.done & IN_BOX(g, dx, dy)) {
            const float power = power_at(g, dx, dy);
            // False for NaN.
            if ((power <= 0.0f) & WORTH_TAKING(power)) {
              const float depth = ray_depth(&frame[j], slope);
              bool behind = (depth > last_depth) |
                            ((depth == last_depth) & (base + j > last_entry));
#if USE_MESH
              behind &= (depth >= nearest) & (depth < farthest);
#endif
              if (behind & (depth < window.depth[RAY_WINDOW - 1])) {
                const float alpha = alpha_of(g, power, effects);
                if (alpha >= ALPHA_CUTOFF / 255.0f)
                  insert(&window, depth, alpha, base + j);
              }
            }
          }
        }
        // Nobody may refill the batch before all have read it.
        barrier(CLK_LOCAL_MEM_FENCE);
      }
      if (item == 0)
        live = 0;
      barrier(CLK_LOCAL_MEM_FENCE);
#pragma unroll
      for (int w = 0; w < RAY_WINDOW; ++w)
        if (!p.done)
          p = blend_entry(tile.records, list, window.entry[w], window.alpha[w],
                          cutoff, effects, p);
      last_depth = window.depth[RAY_WINDOW - 1];
      last_entry = window.entry[RAY_WINDOW - 1];
      if (!p.done)
        atomic_or(&live, 1u);
      barrier(CLK_LOCAL_MEM_FENCE);
      group_live = live != 0;
      // Nobody may clear `live` before all have read it.
      barrier(CLK_LOCAL_MEM_FENCE);
    }
    float transmittance = p.transmittance;
#if USE_LAYERS
    if (p.saturated && layer < most)
      transmittance = -transmittance;
#endif
    if (inside)
      pixels[y * view->size[0] + x] =
          (float4)(p.red, p.green, p.blue, transmittance);
  }
}
