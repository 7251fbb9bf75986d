// The way back through the seven points of unscented.cl. Each goes back through
// the camera at its own place; false where the Jacobian projected the Gaussian.
#pragma once

#include "backward.cl"
#include "unscented.cl"
#if USE_ROLLING_SHUTTER
#include "rolling_backward.cl"
#endif

// dL/d(point) from dL/d(its place), px.
static float3 point_backward(__constant const splat_view *view,
                             __constant const splat_lens *lens,
                             const seen_point *seen, float2 by) {
#if USE_ROLLING_SHUTTER
  const lens_rows j =
      rolling_moved(rolling_rows_at(view, lens, &seen->own, false));
#else
  const lens_rows j = lens_rows_at(view, lens, seen->p, false);
#endif
  return j.x * by.x + j.y * by.y;
}

static bool unscented_backward(__constant const splat_view *view,
                               const camera_gaussian *g,
                               const splat_gradients *by,
                               shape_gradients *to) {
  __constant const splat_lens *lens = (__constant const splat_lens *)(view + 1);
  seen_point mean;
  if (!see_point(view, lens, g->place, &mean))
    return false;
  const camera_axes scaled = scaled_axes(view, g->activated.xyz, g->unit);
  unscented_points points;
  if (!unscented_points_of(view, lens, g->place, place_of(&mean), scaled,
                           &points))
    return false;
#if USE_ROLLING_SHUTTER
  // On the still camera's picture, where the dilation is round.
  const rolling_shear shear =
      rolling_rows_at(view, lens, &mean.own, false).shear;
  const splat_gradients still = rolling_still(by, shear);
  by = &still;
  for (uint n = 0; n < 7; ++n)
    points.off[n] = rolling_unsheared(shear, points.off[n]);
#endif
  const screen_covariance s = unscented_covariance(&points);
  to->opacity = by->opacity * compensation_of(s);

  // dL/d(covariance) times each point's way, by the adjugate as in
  // jacobian_backward().
  float2 by_off[7];
  for (uint n = 0; n < 7; ++n) {
    const float2 off = points.off[n];
    float2 adjugate = (float2)(0.0f, 0.0f);
    for (uint m = 0; m < 7; ++m)
      adjugate += cross2(points.off[m], off) *
                  (float2)(-points.off[m].y, points.off[m].x);
    by_off[n] = by_covariance(by, (adjugate + DILATION * off) / s.det);
#ifdef ANTIALIASED
    if (s.det_sharp / s.det > ANTIALIAS_FLOOR)
      by_off[n] +=
          by_compensation(s, by->opacity, g->activated.w, adjugate, off);
#endif
#if USE_ROLLING_SHUTTER
    by_off[n] = rolling_back(shear, by_off[n]);
#endif
  }

  // The ways from the mean's place to the six others add up to six shifts, so of
  // the covariance only the last one's part depends on the shift.
  const float2 by_shift = -2.8284271f * by_off[6];
  to->place = point_backward(view, lens, &mean, -by_shift);
#if USE_ROLLING_SHUTTER
  // The mean's rows shear the dilation.
  to->place += rolling_rows_backward(
      view, lens, &mean.own,
      rolling_dilation_by_way(lens, shear, by,
                              by_share_kept(s, by->opacity, g->activated.w)),
      0, false);
#endif
  float3 by_axis[3];
  for (uint n = 0; n < 6; ++n) {
    const float2 by_place = 2.0f * UNSCENTED_WEIGHT * by_off[n] +
                            (by->mean + by_shift) / 6.0f;
    const float3 by_point =
        point_backward(view, lens, &points.seen[n], by_place);
    to->place += by_point;
    if (n % 2 == 0)
      by_axis[n / 2] = by_point;
    else
      by_axis[n / 2] = UNSCENTED_STEP * (by_axis[n / 2] - by_point);
  }
  // By steps along the Gaussian's own axes: column k is by axis k's end.
  float3 own_by[3];
  for (uint k = 0; k < 3; ++k)
    own_by[k] = by_axis[k].x * g->axes.x + by_axis[k].y * g->axes.y +
                by_axis[k].z * g->axes.z;
  to->scale = (float3)(own_by[0].x, own_by[1].y, own_by[2].z);
  const float4 scale = g->activated;
  to->turn = (float3)(scale.y * own_by[1].z - scale.z * own_by[2].y,
                      scale.z * own_by[2].x - scale.x * own_by[0].z,
                      scale.x * own_by[0].y - scale.y * own_by[1].x);
  return true;
}
