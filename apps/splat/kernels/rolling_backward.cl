// The way back through what a rolling shutter does to a footprint (rolling.cl).
#pragma once

#include "backward.cl"
#include "rolling.cl"

// dL/d(step of the still camera's picture) from that of the picture.
static float2 rolling_back(rolling_shear a, float2 by) {
  return (float2)(a.yy * by.x - a.yx * by.y, a.xx * by.y - a.xy * by.x) / a.det;
}

// What is blended of a Gaussian as if the still camera's picture were drawn; the
// mean and the opacity stay.
static splat_gradients rolling_still(const splat_gradients *by,
                                     rolling_shear a) {
  const symmetric conic = {by->conic.x, by->conic.y, by->conic.z};
  const float2 x = (float2)(a.xx, a.yx), y = (float2)(a.xy, a.yy);
  const float2 back_x = (float2)(a.yy, -a.xy) / a.det,
               back_y = (float2)(-a.yx, a.xx) / a.det;
  const splat_gradients still = {
      (float3)(quadratic(conic, x, x), quadratic(conic, x, y),
               quadratic(conic, y, y)),
      {quadratic(by->moments, back_x, back_x),
       quadratic(by->moments, back_x, back_y),
       quadratic(by->moments, back_y, back_y)},
      by->mean,
      by->opacity};
  return still;
}

// dL/d(point in the axes of the pose) from dL/d(shear) times the shutter's way,
// and from dL/d(rows of the still camera, in the axes of the pose), if any,
// which the rows of the point `r` make, held if `hold`.
static float3 rolling_rows_backward(VIEW_SPACE const splat_view *view,
                                    VIEW_SPACE const splat_lens *lens,
                                    const rolling_point *r, float2 by_way,
                                    const lens_rows *by_still, bool hold) {
  VIEW_SPACE const splat_shutter *shutter = rolling_shutter_of(lens);
  const float angle = shutter->angle * r->moment;
  const lens_rows j = lens_rows_at(view, lens, r->p, hold);
  lens_rows by_rows = {(float3)(0.0f, 0.0f, 0.0f), (float3)(0.0f, 0.0f, 0.0f)};
  if (by_still) {
    by_rows.x = rolling_turned(shutter, -angle, by_still->x);
    by_rows.y = rolling_turned(shutter, -angle, by_still->y);
  }
  const float3 turn =
      shutter->angle *
      (float3)(shutter->axis[0], shutter->axis[1], shutter->axis[2]);
  // Where time stands still, the moment and the shear are constants.
  const bool moves = fabs(r->moment) < ROLLING_END;
  const float2 way = (float2)(shutter->moment[1], shutter->moment[2]);
  float3 by_rate = (float3)(0.0f, 0.0f, 0.0f);
  float by_moment = 0.0f;
  if (moves) {
    const float2 drift = rolling_drift(r, j);
    const float own = 1.0f - rolling_by(shutter, drift);
    const float left = fmax(own, ROLLING_LEAST);
    float2 by_drift = by_way;
    if (own > ROLLING_LEAST)
      by_drift += (drift.x * by_way.x + drift.y * by_way.y) / left * way;
    by_drift /= left;
    if (by_still)
      by_moment =
          dot_in_order(turn, cross(j.x, by_rows.x) + cross(j.y, by_rows.y));
    by_rate = by_drift.x * j.x + by_drift.y * j.y;
    by_rows.x += by_drift.x * r->rate;
    by_rows.y += by_drift.y * r->rate;
  }
  by_rows.x *= view->focal[0];
  by_rows.y *= view->focal[1];
  float3 by_point = lens_curvature(view, lens, r->p, by_rows, hold);
  if (moves) {
    const float3 motion =
        (float3)(shutter->motion[0], shutter->motion[1], shutter->motion[2]);
    by_point += cross(turn, by_rate);
    by_moment +=
        dot_in_order(by_point, r->rate) +
        dot_in_order(by_rate,
                     cross(turn, rolling_turned(shutter, -angle, motion)));
    const lens_rows own = lens_rows_at(view, lens, r->p, false);
    by_point += by_moment / r->left * (way.x * own.x + way.y * own.y);
  }
  return rolling_turned(shutter, angle, by_point);
}

// dL/d(shear) times the shutter's way, of the whole covariance: what is sheared
// is 2 (shear^-1)^T dL/d(covariance) covariance way, and the last two products
// leave no covariance. `still` is what is blended, as above.
static float2 rolling_by_way(VIEW_SPACE const splat_lens *lens, rolling_shear a,
                             const splat_gradients *still) {
  VIEW_SPACE const splat_shutter *shutter = rolling_shutter_of(lens);
  const float2 way = (float2)(shutter->moment[1], shutter->moment[2]);
  return 2.0f * rolling_back(a, by_covariance(still, way));
}

// The same of the dilation alone. `by_kept` is dL/d(logarithm of the share of
// the determinant that the dilation keeps).
static float2 rolling_dilation_by_way(VIEW_SPACE const splat_lens *lens,
                                      rolling_shear a,
                                      const splat_gradients *still,
                                      float by_kept) {
  VIEW_SPACE const splat_shutter *shutter = rolling_shutter_of(lens);
  const float2 way = (float2)(shutter->moment[1], shutter->moment[2]);
  const symmetric conic = {still->conic.x, still->conic.y, still->conic.z};
  const float2 p = apply(conic, way);
  return 2.0f * DILATION *
         rolling_back(a, by_covariance(still, p) - by_kept * p);
}
