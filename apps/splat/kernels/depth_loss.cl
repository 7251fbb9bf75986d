// Depths that are known of some places of a training picture: the lists are
// blended once more with (depth, 1, 0) for colours, so that a pixel's first
// channel over its second is its expected depth, and the way back through that
// adds to the way back through the picture. Gaussians that no tile sees have
// neither record nor sums.

#include "layout.h"

__kernel void depth_records(__global const uint *depths,
                            __global const splat_gaussian *records,
                            __global splat_gaussian *to, uint count) {
  const uint i = get_global_id(0);
  if (i >= count || depths[i] >= CULLED)
    return;
  splat_gaussian one = records[i];
  one.color[0] = as_float(depths[i]);
  one.color[1] = 1.0f;
  one.color[2] = 0.0f;
  to[i] = one;
}

__kernel void depth_clear(__global float4 *upstream, uint pixels) {
  const uint i = get_global_id(0);
  if (i < pixels)
    upstream[i] = (float4)(0.0f, 0.0f, 0.0f, 0.0f);
}

// The gradient of weight |1 / expected depth - known| of each point; points are
// (pixel, 1 / depth as bits), those of a pixel beside each other, which the first
// one adds up. Where nothing is blended there is no depth and no gradient.
__kernel void depth_loss(__global const uint2 *points, uint count,
                         __global const float4 *pixels,
                         __global float4 *upstream, float weight) {
  const uint i = get_global_id(0);
  if (i >= count)
    return;
  const uint pixel = points[i].x;
  if (i != 0 && points[i - 1].x == pixel)
    return;
  const float4 p = pixels[pixel];
  const float found = p.y / p.x;
  if (!(p.y > 0.0f && found > 0.0f && isfinite(found)))
    return;
  float by_found = 0.0f;
  for (uint k = i; k < count && points[k].x == pixel; ++k) {
    const float known = as_float(points[k].y);
    by_found += found > known ? weight : found < known ? -weight : 0.0f;
  }
  upstream[pixel] =
      (float4)(-by_found * found / p.x, by_found / p.x, 0.0f, 0.0f);
}

// What the blended shapes of `deep` add to those of the picture: planes from
// SUM_S on, as colours are others.
__kernel void depth_add(__global float *sums, __global const float *deep,
                        __global const uint *depths, uint count) {
  const uint i = get_global_id(0);
  if (i >= count || depths[i] >= CULLED)
    return;
  for (uint plane = SUM_S; plane < SUM_WORDS; ++plane)
    sums[plane * count + i] += deep[plane * count + i];
}

// The depth's own gradient goes to the mean, along the camera's axis.
__kernel void depth_to_mean(__constant const splat_view *view,
                            __global const float *deep,
                            __global const uint *depths,
                            __global float *gradients, uint count) {
  const uint i = get_global_id(0);
  if (i >= count || depths[i] >= CULLED)
    return;
  const float by_depth = deep[SUM_COLOR * count + i];
  for (uint k = 0; k < 3; ++k)
    gradients[(GRADIENT_MEAN + k) * count + i] +=
        view->rotation[6 + k] * by_depth;
}
