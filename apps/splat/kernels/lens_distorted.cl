// What pinholes with a distortion share. Their model's file has, before it
// includes this one, with a = x/z, b = y/z and q = a^2 + b^2
//
//     lens_radial_at  the radial part
//     lens_slopes     the derivatives of the place by a and b, in the rows' first
//                     two members
#pragma once

// Points outside the field of view are held at its limits
// (effects/FieldOfView.cpp).
#pragma vorion choice effect USE_FIELD_OF_VIEW

#include "covariance.cl"
#include "layout.h"

#define LENS_HOLDS (USE_FIELD_OF_VIEW != 0)

// x/z and y/z where the Jacobian is taken: within the limits of the rules.
static float2 lens_held(VIEW_SPACE const splat_view *view, float2 ratio,
                        bool hold) {
  if (hold)
    return (float2)(
        clamp(ratio.x, view->ratio_low[0], view->ratio_high[0]),
        clamp(ratio.y, view->ratio_low[1], view->ratio_high[1]));
  return ratio;
}

static bool lens_is_held(VIEW_SPACE const splat_view *view,
                         VIEW_SPACE const splat_lens *lens, float3 p,
                         bool hold) {
  const float2 own = (float2)(p.x / p.z, p.y / p.z);
  return any(lens_held(view, own, hold) != own);
}

static lens_rows lens_jacobian(VIEW_SPACE const splat_view *view,
                               VIEW_SPACE const splat_lens *lens, float3 p,
                               bool hold) {
  const float2 c = lens_held(view, (float2)(p.x / p.z, p.y / p.z), hold);
  const float q = c.x * c.x + c.y * c.y;
  lens_rows s = lens_slopes(lens, c.x, c.y, lens_radial_at(lens, q), q);
  s.x.z = -(s.x.x * c.x + s.x.y * c.y);
  s.y.z = -(s.y.x * c.x + s.y.y * c.y);
  s.x /= p.z;
  s.y /= p.z;
  return s;
}

// One row's part of the derivatives by a, b and z; `second` are its second
// derivatives aa, ab, bb, `slope` its first ones.
static float3 lens_row_curvature(float3 second, float3 slope, float3 by,
                                 float a, float b) {
  const float by_a =
      by.x * second.x + by.y * second.y -
      by.z * (second.x * a + second.y * b + slope.x);
  const float by_b =
      by.x * second.y + by.y * second.z -
      by.z * (second.y * a + second.z * b + slope.y);
  const float row = by.x * slope.x + by.y * slope.y -
                    by.z * (slope.x * a + slope.y * b);
  return (float3)(by_a, by_b, -row);
}
