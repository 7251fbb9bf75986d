// What becomes of a fragment of a surface that is not opaque: nothing, what its
// pixel sees, or a layer of the pixel.
#pragma once

#include "surface.cl"

#include <vorion.h>

// What fragments change.
typedef struct {
  __global uint2 *visible; // a vx_visibility a pixel
  __global uint *counts;   // layers of each pixel, also those beyond MOST_LAYERS
  __global uint2 *layers;  // a plane of vx_visibility for each layer
  uint pixels;             // of the picture
} fragment_targets;

// Whether a fragment is drawn at all. `look` is the material of its triangle.
static bool is_drawn(__global const splat_material *look, float alpha) {
  return look->mode == MATERIAL_MASK ? alpha >= look->cutoff : alpha != 0.0f;
}

// The nearest one stays; of equal depths, the mesh's first triangle.
static void hide(const fragment_targets *to, uint pixel, float depth,
                 uint triangle) {
  const uint2 seen = to->visible[pixel];
  const float nearest = as_float(seen.x);
  if (depth > nearest || (depth == nearest && triangle < seen.y))
    to->visible[pixel] = (uint2)(as_uint(depth), triangle);
}

static void add_layer(const fragment_targets *to, uint pixel, float depth,
                      uint triangle) {
  const uint place = atomic_inc(to->counts + pixel);
  if (place < MOST_LAYERS)
    to->layers[place * to->pixels + pixel] =
        (uint2)(as_uint(depth), triangle);
}
