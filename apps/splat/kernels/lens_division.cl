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

#include "lens_radial.cl"

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
