// The enhanced unified camera model: x and y over
// alpha sqrt(beta (x^2 + y^2) + z^2) + (1 - alpha) z. Depth is z.
#pragma once

#include "covariance.cl"
#include "layout.h"

// With q = (x^2 + y^2) / z^2: the root, over z.
static float lens_root(VIEW_SPACE const splat_lens *lens, float q) {
  return sqrt(1.0f + lens->k[1] * q);
}

// The place over (x/z, y/z), for that root.
static float lens_value(VIEW_SPACE const splat_lens *lens, float root) {
  return 1.0f / (lens->k[0] * root + (1.0f - lens->k[0]));
}

static lens_radial lens_radial_at(VIEW_SPACE const splat_lens *lens, float q) {
  const float root = lens_root(lens, q);
  // The derivative of the root, and of the divisor.
  const float root_slope = lens->k[1] / (2.0f * root);
  const float slope = lens->k[0] * root_slope;
  lens_radial r;
  r.value = lens_value(lens, root);
  r.slope = -slope * r.value * r.value;
  r.curve =
      slope * r.value * r.value * (2.0f * slope * r.value + root_slope / root);
  return r;
}

static float lens_radial_value(VIEW_SPACE const splat_lens *lens, float q) {
  return lens_value(lens, lens_root(lens, q));
}

// The difference of the two roots is a multiple of that of the squares.
static lens_change lens_radial_change(VIEW_SPACE const splat_lens *lens,
                                      float q0, float q, float dq) {
  const float root0 = lens_root(lens, q0), root = lens_root(lens, q);
  const float value0 = lens_value(lens, root0), value = lens_value(lens, root);
  lens_change c;
  c.value = value;
  c.change = -lens->k[0] * lens->k[1] * dq / (root0 + root) * value * value0;
  return c;
}

#include "lens_radial.cl"
