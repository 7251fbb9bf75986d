// What Gaussians are ordered by.
#pragma once

#include "activate.cl"
#include "layout.h"

// Depth along the camera's axis, rounded once: it decides the order, and two
// Gaussians that the exact depths order must not change places by rounding.
static float camera_depth(__local const splat_view *view, float x, float y,
                          float z) {
  const float part[3] = {x, y, z};
  float2 sum = (float2)(view->depth_offset[0], view->depth_offset[1]);
#pragma unroll
  for (int k = 0; k < 3; ++k) {
    const float high = view->depth_axis[k] * part[k];
    const float low = fma(view->depth_axis[k], part[k], -high) +
                      view->depth_axis_low[k] * part[k];
    const float2 next = two_sum(sum.x, high);
    sum = (float2)(next.x, sum.y + (next.y + low));
  }
  return sum.x + sum.y;
}

// Distance from the camera, rounded once as the depth along an axis is: what
// orders them where the model says LENS_BY_DISTANCE.
static float camera_distance(__local const splat_view *view, float3 p) {
  const float part[3] = {p.x, p.y, p.z};
  float2 sum = (float2)(0.0f, 0.0f);
#pragma unroll
  for (int k = 0; k < 3; ++k) {
    const float2 from = two_sum(part[k], -view->position[k]);
    const float2 d = two_sum(from.x, from.y - view->position_low[k]);
    const float square = d.x * d.x;
    const float2 next = two_sum(sum.x, square);
    sum = (float2)(next.x, sum.y + (next.y + (fma(d.x, d.x, -square) +
                                              2.0f * d.x * d.y)));
  }
  const float root = sqrt(sum.x);
  if (!(root > 0.0f) || !isfinite(root))
    return root;
  return root + (fma(-root, root, sum.x) + sum.y) / (2.0f * root);
}
