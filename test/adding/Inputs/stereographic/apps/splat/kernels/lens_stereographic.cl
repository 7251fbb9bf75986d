// A fisheye that keeps angles: 2 / (distance + z) times x and y.
#pragma once

#include "covariance.cl"
#include "crop.cl"
#include "layout.h"

#define LENS_BY_DISTANCE 1
#define LENS_HOLDS false

static bool lens_at(VIEW_SPACE const splat_lens *lens, float3 p, float2 *at) {
  const float sum = sqrt(dot_in_order(p, p)) + p.z;
  *at = 2.0f / sum * p.xy;
  return sum > 0.0f;
}

static bool lens_is_held(VIEW_SPACE const splat_view *view,
                         VIEW_SPACE const splat_lens *lens, float3 p,
                         bool hold) {
  return false;
}

static lens_rows lens_jacobian(VIEW_SPACE const splat_view *view,
                               VIEW_SPACE const splat_lens *lens, float3 p,
                               bool hold) {
  const float distance = sqrt(dot_in_order(p, p)), sum = distance + p.z;
  // The factor, and its derivative by the point.
  const float f = 2.0f / sum;
  const float3 by = -f / sum * (p / distance + (float3)(0.0f, 0.0f, 1.0f));
  lens_rows j = {p.x * by, p.y * by};
  j.x.x += f;
  j.y.y += f;
  return j;
}

static float3 lens_curvature(VIEW_SPACE const splat_view *view,
                             VIEW_SPACE const splat_lens *lens, float3 p,
                             lens_rows by, bool hold) {
  const float distance = sqrt(dot_in_order(p, p)), sum = distance + p.z;
  const float f = 2.0f / sum;
  const float3 unit = p / distance;
  const float3 g = unit + (float3)(0.0f, 0.0f, 1.0f); // of the sum
  const float3 f_by = -f / sum * g;
  // The rows are f e + p_i f_by, and f_by changes by the Hessian of f.
  const float3 both = p.x * by.x + p.y * by.y;
  const float3 hessian =
      2.0f * f / (sum * sum) * dot(g, both) * g -
      f / (sum * distance) * (both - dot(unit, both) * unit);
  float3 d = (by.x.x + by.y.y) * f_by + hessian;
  d.x += dot(by.x, f_by);
  d.y += dot(by.y, f_by);
  return d;
}
