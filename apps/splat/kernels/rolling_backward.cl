// The way back through what a rolling shutter does to a footprint (rolling.cl).

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

// dL/d(point in the axes of the pose) by the shear of the dilation, which the
// rows of the point `r` make, held nowhere. `still` is what is blended, as above;
// `by_kept` is dL/d(logarithm of the share of the determinant that the dilation
// keeps).
static float3 rolling_dilation_backward(VIEW_SPACE const splat_view *view,
                                        VIEW_SPACE const splat_lens *lens,
                                        const rolling_point *r,
                                        rolling_shear a,
                                        const splat_gradients *still,
                                        float by_kept) {
  if (fabs(r->moment) >= ROLLING_END)
    return (float3)(0.0f, 0.0f, 0.0f);
  VIEW_SPACE const splat_shutter *shutter = rolling_shutter_of(lens);
  const float2 way = (float2)(shutter->moment[1], shutter->moment[2]);
  const symmetric conic = {still->conic.x, still->conic.y, still->conic.z};
  const float2 p = apply(conic, way);
  // dL/d(shear) times the way: 2 h (shear^-1)^T dL/d(covariance) way.
  const float2 by_way = 2.0f * DILATION *
                        rolling_back(a, by_covariance(still, p) - by_kept * p);
  const lens_rows j = lens_rows_at(view, lens, r->p, false);
  const float2 drift = rolling_drift(r, j);
  const float left = r->left;
  const float2 by_drift =
      (by_way + (drift.x * by_way.x + drift.y * by_way.y) / left * way) / left;
  const float3 by_rate = by_drift.x * j.x + by_drift.y * j.y;
  const lens_rows by_rows = {view->focal[0] * by_drift.x * r->rate,
                             view->focal[1] * by_drift.y * r->rate};
  const float3 turn = shutter->angle * (float3)(shutter->axis[0],
                                                shutter->axis[1],
                                                shutter->axis[2]);
  const float3 motion =
      (float3)(shutter->motion[0], shutter->motion[1], shutter->motion[2]);
  const float angle = shutter->angle * r->moment;
  const float3 by_point =
      lens_curvature(view, lens, r->p, by_rows, false) + cross(turn, by_rate);
  const float by_moment =
      dot_in_order(by_point, r->rate) +
      dot_in_order(by_rate,
                   cross(turn, rolling_turned(shutter, -angle, motion)));
  return rolling_turned(shutter, angle,
                        by_point + by_moment / left *
                                       (way.x * j.x + way.y * j.y));
}
