// The ray lies at the angle t0 from the axis, in the direction o0 across it.
// `beside` is the point's part along the two directions at right angles to the
// ray: out, by a greater angle, and around the axis. `ray` has t0, its cosine
// and sine, and o0.
#pragma once

static float2 crop_mean(VIEW_SPACE const splat_view *view,
                        VIEW_SPACE const splat_lens *lens,
                        CROP_SPACE const splat_crop *crop, float2 beside,
                        float3 p) {
  VIEW_SPACE const float *k = lens->k;
  const float t0 = crop->ray[0], cosine = crop->ray[1], sine = crop->ray[2];
  const float2 out0 = (float2)(crop->ray[3], crop->ray[4]);
  // The point in the frame of o0, across it and the axis. Near the axis `along`
  // is less than what rounding leaves of x and y.
  const float along = cosine > 0.5f ? (beside.x + p.z * sine) / cosine
                                    : dot(p.xy, out0);
  const float across = beside.y;
  const float radius = sqrt(along * along + across * across);
  // radius - along
  const float bend = along > 0.0f ? across * across / (radius + along)
                                  : radius - along;
  const float dt = atan2(bend * cosine + beside.x, radius * sine + p.z * cosine);
  const float t = t0 + dt;
  // The distorted angle is t F(t^2).
  const float q = t * t, q0 = t0 * t0;
  const float factor0 = lens_angle_factor(lens, q0);
  const float dfactor =
      dt * (t + t0) *
      divided_difference((float4)(k[0], k[1], k[2], k[3]), q, q0);
  const float place0 = t0 * factor0;
  const float dplace = dt * (factor0 + dfactor) + t0 * dfactor;
  const float2 turned = radius > 0.0f
                            ? (float2)(-bend, across) / radius
                            : (float2)(0.0f, 0.0f); // o less o0, in that frame
  const float place = place0 + dplace;
  const float from_out = dplace + place * turned.x;
  const float from_across = place * turned.y;
  return (float2)(
      view->focal[0] * (from_out * out0.x - from_across * out0.y) +
          crop->place[0],
      view->focal[1] * (from_out * out0.y + from_across * out0.x) +
          crop->place[1]);
}
