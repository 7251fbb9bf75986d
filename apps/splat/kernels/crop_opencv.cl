// `beside` is x and y less those of the ray at depth z. `ray` has the ray's x/z
// and y/z, a0 and b0: with a = a0 + da the place's terms less the ray's are
// multiples of da and db, so that nothing cancels.
#pragma once

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
