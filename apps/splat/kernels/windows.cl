// Where the picture is wide (effects/Windows.cpp): gives each window the records
// that its tiles name (window.h), with means measured from the ray through the
// window's middle (crop.cl).

#define CROP_SPACE __global // crop.cl

#include "activate.cl"
#include "covariance.cl"
#include "layout.h"
#include "planes.h"
#include "rectangle.cl"
#include "tile.h"
#include "camera.cl"
#include "crop.cl"

// Windows [x, y) along an axis that tiles [begin, end) meet.
static uint2 window_span(uint bits, uint begin, uint end, uint tile) {
  return (uint2)((begin * tile) >> bits, ((end * tile - 1) >> bits) + 1);
}

// `depths`: the keys that project wrote. What no tile sees has no record. Where
// a Gaussian stands several times, its copies are `apart` records apart. `count`
// Gaussians, `drawn` with their copies.
__kernel void records_of_windows(
    __constant const splat_view *view, __global const float *geometries,
    __global const splat_gaussian *records, __global const uint *depths,
    __global const uint *rectangles, __global const splat_crop *crops,
    __global splat_gaussian *to, uint count, uint drawn, uint apart,
    splat_windows windows) {
  const uint at = get_global_id(0);
  if (at == 0)
    *(__global splat_windows *)to = windows;
  if (at >= drawn || depths[at] >= CULLED)
    return;
  const uint i = at % apart;
#ifdef SCENE_IN_BLOCKS
  __global const float *geometry =
      geometries + i / LINE_WORDS * LINE_WORDS * GEOMETRY_PLANES +
      i % LINE_WORDS;
#else
  __global const float *geometry = geometries;
#endif
  const float3 mean = (float3)(GEOMETRY(PLANE_MEAN), GEOMETRY(PLANE_MEAN + 1),
                               GEOMETRY(PLANE_MEAN + 2));
  const float depth = as_float(depths[at]);
#if HAS_LENS
  __constant const splat_lens *lens = (__constant const splat_lens *)(view + 1);
  __constant const float *r = view->rotation;
  const float3 d = from_camera(view, mean);
  const float3 p =
      (float3)(r[0] * d.x + r[1] * d.y + r[2] * d.z,
               r[3] * d.x + r[4] * d.y + r[5] * d.z,
#if LENS_BY_DISTANCE
               r[6] * d.x + r[7] * d.y + r[8] * d.z);
#else
               depth);
#endif
#endif
  splat_gaussian g = records[at];
#if LENS_CLOSES
  const float own = g.mean[0], width = (float)view->size[0];
#endif
  const uint2 rectangle = (uint2)(rectangles[at], rectangles[drawn + at]);
  const uint2 across =
      window_span(windows.bits, first_column(rectangle),
                  rectangle.y & 0xffff, TILE_SIZE);
  const uint2 down = window_span(windows.bits, first_row(rectangle),
                                 rectangle.y >> 16, TILE_HEIGHT);
  for (uint y = down.x; y < down.y; ++y)
    for (uint x = across.x; x < across.y; ++x) {
      const uint window = y * windows.columns + x;
      __global const splat_crop *crop = crops + window;
      const float2 beside =
          (float2)(beside_ray(view, crop, 0, mean.x, mean.y, mean.z),
                   beside_ray(view, crop, 1, mean.x, mean.y, mean.z));
#if HAS_LENS
      float2 place = crop_mean(view, lens, crop, beside, p);
#else
      float2 place = crop_mean(view, crop, beside, depth);
#endif
#if LENS_CLOSES
      // The copy's own, of those that are a picture's width apart.
      place.x += width * rint((own - (float)(x << windows.bits) - place.x) /
                              width);
#endif
      g.mean[0] = place.x;
      g.mean[1] = place.y;
      to[1 + window * windows.stride + at] = g;
    }
}
