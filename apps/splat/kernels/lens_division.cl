// Fitzgibbon's division model: what is shown at the distance d from the
// principal point, a pinhole shows at d / (1 + k d^2). Depth is z.
#pragma once

#include "covariance.cl"
#include "crop.cl"
#include "layout.h"

// The root of 1 - 4 k q, which is 0 at the limit.
static float lens_root(float k, float q) {
  return sqrt(fmax(1.0f - 4.0f * k * q, 0.0f));
}

static lens_radial lens_radial_at(VIEW_SPACE const splat_lens *lens, float q) {
  const float k = lens->k[0], root = lens_root(k, q);
  lens_radial r;
  r.value = 2.0f / (1.0f + root);
  r.slope = k * r.value * r.value / root;
  r.curve = 2.0f * k * r.slope * (r.value * root + 1.0f) / (root * root);
  return r;
}

static bool lens_at(VIEW_SPACE const splat_lens *lens, float3 p, float2 *at) {
  const float a = p.x / p.z, b = p.y / p.z;
  const float q = a * a + b * b;
  *at = 2.0f / (1.0f + lens_root(lens->k[0], q)) * (float2)(a, b);
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
// and y/z, a0 and b0. The difference of the two quotients 2 / (1 + root) is a
// multiple of that of the squares.
static float2 crop_mean(VIEW_SPACE const splat_view *view,
                        VIEW_SPACE const splat_lens *lens,
                        CROP_SPACE const splat_crop *crop, float2 beside,
                        float3 p) {
  const float k = lens->k[0];
  const float a0 = crop->ray[0], b0 = crop->ray[1];
  const float da = beside.x / p.z, db = beside.y / p.z;
  const float a = a0 + da, b = b0 + db;
  const float dq = da * (a0 + a) + db * (b0 + b);
  const float root0 = lens_root(k, a0 * a0 + b0 * b0);
  const float root = lens_root(k, a * a + b * b);
  const float radial0 = 2.0f / (1.0f + root0), radial = 2.0f / (1.0f + root);
  const float dradial = 2.0f * k * dq * radial * radial0 / (root + root0);
  return (float2)(view->focal[0] * (da * radial + a0 * dradial) +
                      crop->place[0],
                  view->focal[1] * (db * radial + b0 * dradial) +
                      crop->place[1]);
}
