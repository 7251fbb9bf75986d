// What pinholes with a distortion share that depends on the radius alone. Their
// model's file has lens_radial_at before it includes this one.
#pragma once

#include "covariance.cl"
#include "layout.h"

// The derivatives of the place by a and b, in the rows' first two members.
static lens_rows lens_slopes(VIEW_SPACE const splat_lens *lens, float a, float b,
                             lens_radial r, float q) {
  const float mixed = 2.0f * a * b * r.slope;
  lens_rows s;
  s.x = (float3)(r.value + 2.0f * a * a * r.slope, mixed, 0.0f);
  s.y = (float3)(mixed, r.value + 2.0f * b * b * r.slope, 0.0f);
  return s;
}

#include "lens_distorted.cl"

static float3 lens_curvature(VIEW_SPACE const splat_view *view,
                             VIEW_SPACE const splat_lens *lens, float3 p,
                             lens_rows by, bool hold) {
  const float2 ratio = (float2)(p.x / p.z, p.y / p.z);
  const float2 c = lens_held(view, ratio, hold);
  const float a = c.x, b = c.y, q = a * a + b * b;
  const lens_radial r = lens_radial_at(lens, q);
  const lens_rows s = lens_slopes(lens, a, b, r, q);
  // The second derivatives aa, ab, bb.
  const float x_first = 2.0f * a * (r.slope + 2.0f * b * b * r.curve);
  const float y_first = 2.0f * b * (r.slope + 2.0f * a * a * r.curve);
  const float3 second_x = (float3)(
      a * (6.0f * r.slope + 4.0f * a * a * r.curve), y_first, x_first);
  const float3 second_y = (float3)(
      y_first, x_first, b * (6.0f * r.slope + 4.0f * b * b * r.curve));
  // By a, b, and z at a and b.
  const float3 d = (lens_row_curvature(second_x, s.x, by.x, a, b) +
                    lens_row_curvature(second_y, s.y, by.y, a, b)) /
                   p.z;
  // A slope at its limit stays there.
  const float by_a = a == ratio.x ? d.x / p.z : 0.0f;
  const float by_b = b == ratio.y ? d.y / p.z : 0.0f;
  return (float3)(by_a, by_b, d.z / p.z - by_a * ratio.x - by_b * ratio.y);
}
