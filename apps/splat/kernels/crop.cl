// Where fp32 has too few digits for places from the axis (effects/Crop.cpp,
// effects/Windows.cpp): how far beside the ray through the picture's or a
// window's middle a point is, rounded once. The camera's model makes a place of
// it (lens_model.cl).
#pragma once

#include "activate.cl"
#include "covariance.cl"
#include "layout.h"

// Where a kernel keeps the ray.
#ifndef CROP_SPACE
#define CROP_SPACE VIEW_SPACE
#endif

// As the sum of two floats.
static float2 beside_ray2(VIEW_SPACE const splat_view *view,
                          CROP_SPACE const splat_crop *crop, int axis, float x,
                          float y, float z) {
  const float part[3] = {x, y, z};
  float2 beside = (float2)(-crop->start[axis], -crop->start_low[axis]);
#pragma unroll
  for (int k = 0; k < 3; ++k) {
    const float2 from = two_sum(part[k], -view->position[k]);
    const float2 d = two_sum(from.x, from.y - view->position_low[k]);
    const float high = crop->across[axis][k] * d.x;
    const float low = fma(crop->across[axis][k], d.x, -high) +
                      crop->across_low[axis][k] * d.x +
                      crop->across[axis][k] * d.y;
    const float2 next = two_sum(beside.x, high);
    beside = (float2)(next.x, beside.y + (next.y + low));
  }
  return beside;
}

static float beside_ray(VIEW_SPACE const splat_view *view,
                        CROP_SPACE const splat_crop *crop, int axis, float x,
                        float y, float z) {
  const float2 beside = beside_ray2(view, crop, axis, x, y, z);
  return beside.x + beside.y;
}

// (P(q) - P(q0)) / (q - q0) where P(q) = k.x q + k.y q^2 + k.z q^3 + k.w q^4.
static float divided_difference(float4 k, float q, float q0) {
  const float sum = q + q0, squares = q * q + q0 * q0;
  return k.x + k.y * sum + k.z * (squares + q * q0) + k.w * sum * squares;
}
