// Fitzgibbon's division model: what is shown at the distance d from the
// principal point, a pinhole shows at d / (1 + k d^2). Depth is z.
#pragma once

#include "covariance.cl"
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

static float lens_radial_value(VIEW_SPACE const splat_lens *lens, float q) {
  return 2.0f / (1.0f + lens_root(lens->k[0], q));
}

// The difference of the two quotients 2 / (1 + root) is a multiple of that of
// the squares.
static lens_change lens_radial_change(VIEW_SPACE const splat_lens *lens,
                                      float q0, float q, float dq) {
  const float k = lens->k[0];
  const float root0 = lens_root(k, q0), root = lens_root(k, q);
  const float value0 = 2.0f / (1.0f + root0), value = 2.0f / (1.0f + root);
  lens_change c;
  c.value = value;
  c.change = 2.0f * k * dq * value * value0 / (root + root0);
  return c;
}

#include "lens_radial.cl"
