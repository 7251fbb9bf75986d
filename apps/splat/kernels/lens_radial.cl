// What pinholes with a distortion share that depends on the radius alone. With q
// = (x/z)^2 + (y/z)^2, their model's file has, before it includes this one,
//
//     lens_radial_at      the factor of x/z and y/z at q, and its derivatives
//     lens_radial_value   the factor alone
//     lens_radial_change  the factor at q, and how it differs from that at q0,
//                         from dq = q - q0 without a cancellation
#pragma once

#include "covariance.cl"
#include "crop.cl"
#include "layout.h"

static bool lens_at(VIEW_SPACE const splat_lens *lens, float3 p, float2 *at) {
  const float a = p.x / p.z, b = p.y / p.z;
  const float q = a * a + b * b;
  *at = lens_radial_value(lens, q) * (float2)(a, b);
  return p.z > 0.0f && q < lens->limit;
}

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

// `beside` is x and y less those of the ray at depth z. `ray` has the ray's x/z
// and y/z, a0 and b0.
static float2 crop_mean(VIEW_SPACE const splat_view *view,
                        VIEW_SPACE const splat_lens *lens,
                        CROP_SPACE const splat_crop *crop, float2 beside,
                        float3 p) {
  const float a0 = crop->ray[0], b0 = crop->ray[1];
  const float da = beside.x / p.z, db = beside.y / p.z;
  const float a = a0 + da, b = b0 + db;
  const float dq = da * (a0 + a) + db * (b0 + b);
  const lens_change c =
      lens_radial_change(lens, a0 * a0 + b0 * b0, a * a + b * b, dq);
  return (float2)(
      view->focal[0] * (da * c.value + a0 * c.change) + crop->place[0],
      view->focal[1] * (db * c.value + b0 * c.change) + crop->place[1]);
}
