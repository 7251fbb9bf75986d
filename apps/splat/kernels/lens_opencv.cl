// A pinhole with OpenCV's distortion: radial (a ratio of polynomials of r^2),
// tangential and of a thin prism. Depth is z.
#pragma once

#include "covariance.cl"
#include "crop.cl"
#include "layout.h"

static lens_radial lens_radial_at(VIEW_SPACE const splat_lens *lens, float q) {
  VIEW_SPACE const float *k = lens->k;
  const float over = 1.0f + q * (k[0] + q * (k[1] + q * (k[4] + q * k[12])));
  const float over1 = k[0] + q * (2.0f * k[1] + 3.0f * q * k[4] +
                                  4.0f * q * q * k[12]);
  const float over2 = 2.0f * k[1] + 6.0f * q * k[4] + 12.0f * q * q * k[12];
  const float under = 1.0f + q * (k[5] + q * (k[6] + q * k[7]));
  const float under1 = k[5] + q * (2.0f * k[6] + 3.0f * q * k[7]);
  const float under2 = 2.0f * k[6] + 6.0f * q * k[7];
  lens_radial r;
  r.value = over / under;
  r.slope = (over1 - r.value * under1) / under;
  r.curve = (over2 - 2.0f * r.slope * under1 - r.value * under2) / under;
  return r;
}

// Beyond the limit the radial part turns back or has passed a pole.
static bool lens_at(VIEW_SPACE const splat_lens *lens, float3 p, float2 *at) {
  VIEW_SPACE const float *k = lens->k;
  const float a = p.x / p.z, b = p.y / p.z;
  const float q = a * a + b * b;
  const float radial = lens_radial_at(lens, q).value;
  const float both = 2.0f * a * b;
  *at = (float2)(a * radial + k[2] * both + k[3] * (q + 2.0f * a * a) +
                     q * (k[8] + q * k[9]),
                 b * radial + k[2] * (q + 2.0f * b * b) + k[3] * both +
                     q * (k[10] + q * k[11]));
  return p.z > 0.0f && q < lens->limit;
}

// The derivatives of the place by a and b, in the rows' first two members.
static lens_rows lens_slopes(VIEW_SPACE const splat_lens *lens, float a, float b,
                             lens_radial r, float q) {
  VIEW_SPACE const float *k = lens->k;
  const float mixed = 2.0f * a * b * r.slope;
  const float prism_x = 2.0f * (k[8] + 2.0f * k[9] * q);
  const float prism_y = 2.0f * (k[10] + 2.0f * k[11] * q);
  lens_rows s;
  s.x = (float3)(r.value + 2.0f * a * a * r.slope + 2.0f * k[2] * b +
                     6.0f * k[3] * a + a * prism_x,
                 mixed + 2.0f * k[2] * a + 2.0f * k[3] * b + b * prism_x, 0.0f);
  s.y = (float3)(mixed + 2.0f * k[2] * a + 2.0f * k[3] * b + a * prism_y,
                 r.value + 2.0f * b * b * r.slope + 6.0f * k[2] * b +
                     2.0f * k[3] * a + b * prism_y,
                 0.0f);
  return s;
}

#include "lens_distorted.cl"

static float3 lens_curvature(VIEW_SPACE const splat_view *view,
                             VIEW_SPACE const splat_lens *lens, float3 p,
                             lens_rows by, bool hold) {
  VIEW_SPACE const float *k = lens->k;
  const float2 ratio = (float2)(p.x / p.z, p.y / p.z);
  const float2 c = lens_held(view, ratio, hold);
  const float a = c.x, b = c.y, q = a * a + b * b;
  const lens_radial r = lens_radial_at(lens, q);
  const lens_rows s = lens_slopes(lens, a, b, r, q);
  const float prism_x = 2.0f * k[8] + 4.0f * k[9] * q;
  const float prism_y = 2.0f * k[10] + 4.0f * k[11] * q;
  const float x_first = 2.0f * (a * r.slope + 2.0f * a * b * b * r.curve + k[3]);
  const float y_first = 2.0f * (b * r.slope + 2.0f * a * a * b * r.curve + k[2]);
  const float3 second_x = (float3)(
      6.0f * a * r.slope + 4.0f * a * a * a * r.curve + 6.0f * k[3] + prism_x +
          8.0f * a * a * k[9],
      y_first + 8.0f * a * b * k[9], x_first + prism_x + 8.0f * b * b * k[9]);
  const float3 second_y = (float3)(
      y_first + prism_y + 8.0f * a * a * k[11], x_first + 8.0f * a * b * k[11],
      6.0f * b * r.slope + 4.0f * b * b * b * r.curve + 6.0f * k[2] + prism_y +
          8.0f * b * b * k[11]);
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
// and y/z, a0 and b0: with a = a0 + da the place's terms less the ray's are
// multiples of da and db, so that nothing cancels.
static float2 crop_mean(VIEW_SPACE const splat_view *view,
                        VIEW_SPACE const splat_lens *lens,
                        CROP_SPACE const splat_crop *crop, float2 beside,
                        float3 p) {
  VIEW_SPACE const float *k = lens->k;
  const float a0 = crop->ray[0], b0 = crop->ray[1];
  const float da = beside.x / p.z, db = beside.y / p.z;
  const float a = a0 + da, b = b0 + db;
  const float q0 = a0 * a0 + b0 * b0, q = a * a + b * b;
  const float dq = da * (a0 + a) + db * (b0 + b);
  // The radial part is over / under.
  const float under = 1.0f + q * (k[5] + q * (k[6] + q * k[7]));
  const float radial0 = lens_radial_at(lens, q0).value;
  const float dover =
      divided_difference((float4)(k[0], k[1], k[4], k[12]), q, q0);
  const float dunder =
      divided_difference((float4)(k[5], k[6], k[7], 0.0f), q, q0);
  const float dradial = dq * (dover - radial0 * dunder) / under;
  const float radial = radial0 + dradial;
  const float both = 2.0f * (da * b + a0 * db);
  const float prism = q + q0;
  const float x = da * radial + a0 * dradial + k[2] * both +
                  k[3] * (dq + 2.0f * da * (a0 + a)) +
                  dq * (k[8] + prism * k[9]);
  const float y = db * radial + b0 * dradial +
                  k[2] * (dq + 2.0f * db * (b0 + b)) + k[3] * both +
                  dq * (k[10] + prism * k[11]);
  return (float2)(view->focal[0] * x + crop->place[0],
                  view->focal[1] * y + crop->place[1]);
}
